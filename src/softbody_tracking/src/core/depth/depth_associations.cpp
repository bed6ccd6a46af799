#include "depth/depth_associations.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/protocol/target_limits.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

constexpr double kMinSlope =
    0.05;  // normal times ray at z = 1; below it the plane's depth is ill-conditioned
constexpr double kSmallestVariance = 1e-6 / 12.0;  // [m^2] of depth in a block: cameras round to 1 mm
constexpr double kUsualRelativeNoise = 0.013;  // see downweightByNoise; with more noise a thin body shakes
constexpr double kMinNoiseWeight = 1.0 / 6.0;  // smallest factor: only depth gives the body's distance

using Block = DepthBlock;
using BlockKind = DepthBlock::Kind;

/// Offsets first .. end - 1 that keep both a + offset and b + offset in [0, length).
struct Offsets {
  int first, end;
};

Offsets offsetsInside(int a, int b, int size, int length) {
  return {std::max({-(size / 2), -a, -b}), std::min({size - size / 2, length - a, length - b})};
}

/// Pixels of a block with measured depth, and the sums over those that show the body.
struct BlockPixels {
  int measured = 0, agreeing = 0, nearer = 0, farther = 0;
  float sum = 0.0f, squares = 0.0f;  ///< of measured minus predicted depth
};

/// Around the sample, the predicted shape is the rendered one.
BlockPixels pixelsOf(const Block& block, const RgbdFrame& frame, const RasterImage& image,
                     const cv::Point& rendered_center, int size, int step, const Labels& labels) {
  const cv::Point& center = block.center;
  const Offsets columns = offsetsInside(rendered_center.x, center.x, size, frame.depth.cols);
  const Offsets rows = offsetsInside(rendered_center.y, center.y, size, frame.depth.rows);
  const auto nearer_by = static_cast<float>(block.predicted) - image.depth(rendered_center);
  const auto gate = static_cast<float>(kReach_m);
  const cv::Rect& labelled = labels.region;
  BlockPixels pixels;
  for (int j = rows.first; j < rows.end; j += step) {
    const float* rendered = image.depth[rendered_center.y + j] + rendered_center.x;
    const float* depth = frame.depth[center.y + j] + center.x;
    const int row = center.y + j - labelled.y, first = center.x - labelled.x;
    if (row < 0 || row >= labelled.height) continue;
    const std::uint8_t* label_row = labels.label[row];
    for (int i = columns.first; i < columns.end; i += step) {
      if (rendered[i] <= 0.0f || !(depth[i] > 0.0f)) continue;
      if (first + i < 0 || first + i >= labelled.width) continue;
      const std::uint8_t label = label_row[first + i];
      if (label == labels::kUnknown) continue;
      ++pixels.measured;
      const float difference = depth[i] - rendered[i] - nearer_by;
      if (label == labels::kBody && std::abs(difference) <= gate) {
        ++pixels.agreeing;
        pixels.sum += difference;
        pixels.squares += difference * difference;
      } else {
        ++(label == labels::kBackground || (label == labels::kBody && difference > 0.0f) ? pixels.farther
                                                                                         : pixels.nearer);
      }
    }
  }
  return pixels;
}

/// Classifies a block by the majority of its pixels.
void classify(const BlockPixels& pixels, Block* block) {
  if (pixels.measured == 0) return;
  if (pixels.agreeing > 0) {
    const float mean = pixels.sum / static_cast<float>(pixels.agreeing);
    block->difference = mean;
    block->variance = std::max<double>(kSmallestVariance,
                                       pixels.squares / static_cast<float>(pixels.agreeing) - mean * mean);
  }
  block->kind = BlockKind::kUnmeasured;
  if (2 * pixels.nearer > pixels.measured) {
    block->kind = BlockKind::kOccluded;
  } else if (2 * pixels.farther > pixels.measured) {
    block->kind = BlockKind::kAbsent;
  } else if (2 * pixels.agreeing > pixels.measured) {
    block->kind = BlockKind::kAgrees;
  }
}

/// Moves a sample by the rigid motion, and compares it with the frame's depth there.
Block observe(const RgbdFrame& frame, const RasterImage& image, const SurfaceSample& sample, int size,
              int step, const Eigen::Isometry3d& motion, const Labels& labels) {
  Block block;
  block.position = motion * sample.position;
  block.normal = motion.linear() * sample.normal;
  if (!(block.position.z() > 0.0)) return block;
  const Eigen::Vector2d pixel = frame.camera.project(block.position);
  if (!frame.camera.contains(pixel.x(), pixel.y())) return block;
  block.center = {cvRound(pixel.x()), cvRound(pixel.y())};
  const double slope = block.normal.dot(frame.camera.unproject(block.center.x, block.center.y, 1.0));
  if (-slope < kMinSlope) return block;
  block.predicted = block.normal.dot(block.position) / slope;
  classify(pixelsOf(block, frame, image, sample.center, size, step, labels), &block);
  return block;
}

/// Variance that depth differences usually have within a block [m^2]: the median.
double usualVariance(const std::vector<Block>& blocks) {
  std::vector<double> variances;
  for (const Block& block : blocks)
    if (block.kind == BlockKind::kAgrees) variances.push_back(block.variance);
  return median(&variances);
}

Association associationOf(const Block& block, const SurfaceSample& sample, const Pinhole& camera,
                          double weight) {
  Association association;
  association.kind = TargetKind::kDepth;
  association.place = sample.place;
  association.piece = sample.piece;
  association.predicted = block.position;
  association.measured = camera.unproject(block.center.x, block.center.y, block.predicted + block.difference);
  association.normal = block.normal;
  association.weight = std::min(weight, kLargestTargetWeight);
  return association;
}

}  // namespace

void downweightByNoise(double relative_noise, DepthAssociations* depth) {
  if (relative_noise <= kUsualRelativeNoise) return;
  const double scale = std::max(kMinNoiseWeight, std::pow(kUsualRelativeNoise / relative_noise, 2));
  for (Association& association : depth->associations) association.weight *= scale;
}

DepthAssociations associateDepth(const RgbdFrame& frame, const RasterImage& image,
                                 const SurfaceSamples& surface, const RigidMotions& motions,
                                 const Labels& labels, const DepthWeight& weight, int pixel_step) {
  const int step = std::min(pixel_step, surface.block_px);
  std::vector<Block> blocks;
  blocks.reserve(surface.samples.size());
  for (const SurfaceSample& sample : surface.samples) {
    blocks.push_back(observe(frame, image, sample, surface.block_px, step, motions[sample.piece], labels));
  }
  DepthAssociations found;
  if (pixel_step == 1) found.noise = sampleDepthNoise(surface, blocks, frame.camera.fx);

  const double usual_variance = usualVariance(blocks);
  found.associations.reserve(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    if (block.kind == BlockKind::kUnmeasured) continue;
    ++found.visible_blocks;
    found.occluded_blocks += block.kind == BlockKind::kOccluded ? 1 : 0;
    found.absent_blocks += block.kind == BlockKind::kAbsent ? 1 : 0;
    if (block.kind != BlockKind::kAgrees) continue;
    const double cosine = -block.normal.dot(block.position.normalized());
    if (cosine <= 0.0) continue;
    const double width = surface.block_px * block.position.z() / (frame.camera.fx * weight.edge_m);
    // Per area of the surface, not of the image.
    const double of_block = weight.per_area * width * width / cosine;
    // A block has few pixels: its variance is estimated halfway between its own and the usual one.
    const double precision = 2.0 * usual_variance / (usual_variance + block.variance);
    found.associations.push_back(
        associationOf(block, surface.samples[i], frame.camera, of_block * precision));
  }
  weighByResidual(kRobustScale, &found.associations);
  return found;
}

}  // namespace softbody
