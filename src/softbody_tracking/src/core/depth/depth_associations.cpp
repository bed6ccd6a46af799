#include "depth/depth_associations.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "prediction/depth_evidence.h"
#include "softbody_common/target_limits.h"
#include "statistics/median.h"

namespace softbody {
namespace {

constexpr double kMinSlope =
    0.05;  // normal times ray at z = 1; below it the plane's depth is ill-conditioned
constexpr double kSmallestVariance = 1e-6 / 12.0;  // [m^2] of depth in a block: cameras round to 1 mm
constexpr double kDepthScale = 4.0;                // of the robust loss, in median residuals
constexpr double kOccluderStep = 0.003;  // [m] an occluder's end is at least this far before the prediction
constexpr double kOccluderContinuity =
    0.008;                             // [m] largest depth step between neighbouring blocks of an occluder
constexpr double kProtrusion = 0.01;   // [m] an object this far before the surface beside it occludes it,
constexpr double kMaxSteepness = 1.0;  // if this times their distance is less: no body bends so steeply
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
                     const cv::Point& rendered_center, int size, int step, const RegionColors& colors,
                     double reach_m) {
  const cv::Point& center = block.center;
  const Offsets columns = offsetsInside(rendered_center.x, center.x, size, frame.depth.cols);
  const Offsets rows = offsetsInside(rendered_center.y, center.y, size, frame.depth.rows);
  const auto nearer_by = static_cast<float>(block.predicted) - image.depth(rendered_center);
  const auto gate = static_cast<float>(reach_m);
  BlockPixels pixels;
  for (int j = rows.first; j < rows.end; j += step) {
    const float* rendered = image.depth[rendered_center.y + j] + rendered_center.x;
    const float* depth = frame.depth[center.y + j] + center.x;
    const cv::Vec3b* color = frame.color[center.y + j] + center.x;
    for (int i = columns.first; i < columns.end; i += step) {
      if (rendered[i] <= 0.0f || depth[i] <= 0.0f) continue;
      ++pixels.measured;
      const float difference = depth[i] - rendered[i] - nearer_by;
      const bool body = std::abs(difference) <= gate &&
                        colors.logOdds(color[i]) + DepthEvidence::logOdds(difference, block.predicted) > 0.0;
      if (!body) {
        ++(difference > kBehindSurface ? pixels.farther : pixels.nearer);
      } else {
        ++pixels.agreeing;
        pixels.sum += difference;
        pixels.squares += difference * difference;
      }
    }
  }
  return pixels;
}

/// Classifies a block by the majority of its pixels.
void classify(const BlockPixels& pixels, const RgbdFrame& frame, Block* block) {
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
    block->difference = frame.depth(block->center) - block->predicted;
  } else if (2 * pixels.farther > pixels.measured) {
    block->kind = BlockKind::kAbsent;
  } else if (2 * pixels.agreeing > pixels.measured) {
    block->kind = BlockKind::kAgrees;
  }
}

/// Moves a sample by the rigid motion, and compares it with the frame's depth there.
Block observe(const RgbdFrame& frame, const RasterImage& image, const SurfaceSample& sample, int size,
              int step, const Eigen::Isometry3d& motion, const RegionColors& colors, double reach_m) {
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
  classify(pixelsOf(block, frame, image, sample.center, size, step, colors, reach_m), frame, &block);
  return block;
}

double measuredDepth(const Block& block) { return block.predicted + block.difference; }

/// Whether an occluder continues from one block to the next: without a step in depth, or with the same slope
/// as from the block before. A blade seen from above is steep.
bool continues(const Block* before, const Block& occluder, const Block& next) {
  const double step = measuredDepth(next) - measuredDepth(occluder);
  if (std::abs(step) < kOccluderContinuity) return true;
  if (before == nullptr || before->kind != BlockKind::kOccluded) return false;
  const double last_step = measuredDepth(occluder) - measuredDepth(*before);
  return std::abs(step - last_step) < kOccluderContinuity;
}

/// Compares each block with its piece. What a whole piece does is no occluder's doing.
void subtractMotionOfPieces(const SurfaceSamples& surface, std::vector<Block>* blocks) {
  std::map<std::uint32_t, std::vector<double>> differences;
  for (std::size_t b = 0; b < blocks->size(); ++b) {
    if ((*blocks)[b].kind == BlockKind::kAgrees)
      differences[surface.samples[b].piece].push_back((*blocks)[b].difference);
  }
  std::map<std::uint32_t, double> of_piece;
  for (auto& [piece, values] : differences) of_piece[piece] = median(&values);
  for (std::size_t b = 0; b < blocks->size(); ++b)
    (*blocks)[b].excess = (*blocks)[b].difference - of_piece[surface.samples[b].piece];
}

/// Variance that depth differences usually have within a block [m^2]: the median.
double usualVariance(const std::vector<Block>& blocks) {
  std::vector<double> variances;
  for (const Block& block : blocks)
    if (block.kind == BlockKind::kAgrees) variances.push_back(block.variance);
  return median(&variances);
}

/// Whether a block lies before the surface that another block of the same smooth surface shows.
bool protrudesFrom(const Block& block, const Block& other) {
  return other.kind == BlockKind::kAgrees && std::abs(other.excess) < kOccluderStep &&
         block.difference <
             other.difference -
                 std::max(kProtrusion, kMaxSteepness * (block.position - other.position).norm()) &&
         std::abs(block.predicted - other.predicted) < kOccluderContinuity;
}

/// Marks blocks that protrude from the surface by a step as occluded, whatever their colour: a tool's handle
/// may be within the depth gate. Blocks at the border of an object show both, so the second neighbours count
/// too.
void markProtrusions(const SurfaceSamples& surface, std::vector<Block>* blocks) {
  const cv::Mat1i& grid = surface.grid;
  const cv::Rect inside(cv::Point(), grid.size());
  std::vector<int> protruding;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.cols; ++column) {
      const int b = grid(row, column);
      if (b < 0 || (*blocks)[b].kind != BlockKind::kAgrees || (*blocks)[b].excess > -kProtrusion) continue;
      for (const cv::Point& way : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1),
                                   cv::Point(2, 0), cv::Point(-2, 0), cv::Point(0, 2), cv::Point(0, -2)}) {
        const cv::Point place = cv::Point(column, row) + way;
        const int other = inside.contains(place) ? grid(place) : -1;
        if (other < 0 || surface.samples[other].piece != surface.samples[b].piece) continue;
        if (!protrudesFrom((*blocks)[b], (*blocks)[other])) continue;
        protruding.push_back(b);
        break;
      }
    }
  }
  for (const int b : protruding) (*blocks)[b].kind = BlockKind::kOccluded;
}

/// Marks the rest of a hand, of which one end has been recognised as an occluder.
void growOccluders(const cv::Mat1i& grid, std::vector<Block>* blocks) {
  std::vector<cv::Point> open;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.cols; ++column) {
      const int b = grid(row, column);
      if (b >= 0 && (*blocks)[b].kind == BlockKind::kOccluded) open.emplace_back(column, row);
    }
  }
  const cv::Rect inside(cv::Point(), grid.size());
  while (!open.empty()) {
    const cv::Point place = open.back();
    open.pop_back();
    const Block& occluder = (*blocks)[grid(place)];
    for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point next = place + step;
      if (!inside.contains(next) || grid(next) < 0) continue;
      Block& block = (*blocks)[grid(next)];
      const cv::Point back = place - step;
      const Block* before = inside.contains(back) && grid(back) >= 0 ? &(*blocks)[grid(back)] : nullptr;
      const bool same_occluder = block.kind == BlockKind::kAgrees && block.excess < -kOccluderStep &&
                                 continues(before, occluder, block);
      if (!same_occluder) continue;
      block.kind = BlockKind::kOccluded;
      open.push_back(next);
    }
  }
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
                                 const RegionColors& colors, const DepthWeight& weight, int pixel_step) {
  const int step = std::min(pixel_step, surface.block_px);
  std::vector<Block> blocks;
  blocks.reserve(surface.samples.size());
  for (const SurfaceSample& sample : surface.samples) {
    blocks.push_back(
        observe(frame, image, sample, surface.block_px, step, motions[sample.piece], colors, weight.reach_m));
  }
  subtractMotionOfPieces(surface, &blocks);
  markProtrusions(surface, &blocks);
  growOccluders(surface.grid, &blocks);
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
  weighByResidual(kDepthScale, &found.associations);
  return found;
}

}  // namespace softbody
