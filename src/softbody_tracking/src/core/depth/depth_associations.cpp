#include "depth/depth_associations.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/target_limits.h"

namespace softbody {
namespace {

constexpr double kMostGrazing = 0.1;           // cosine between normal and ray below which depth says little
constexpr double kOccluderStep = 0.003;        // [m] in front of the prediction that an occluder's end may be
constexpr double kOccluderContinuity = 0.008;  // [m] between neighbouring blocks of one occluder
constexpr double kStandsOut = 0.01;            // [m] before the surface beside it, and
constexpr double kSteepest = 1.0;              // times the distance between them: no body bends so
constexpr double kUsualNoise =
    0.013;  // of the mean over an edge, as a share of it; with more a thin body shakes
constexpr double kLeastTrust = 1.0 / 6.0;  // in depth: nothing else says how far away the body is

using Block = DepthBlock;
using BlockKind = DepthBlock::Kind;

/// Offsets from first to one before end that keep both places in [0, length).
struct Offsets {
  int first, end;
};

Offsets offsetsInside(int a, int b, int size, int length) {
  return {std::max({-(size / 2), -a, -b}), std::min({size - size / 2, length - a, length - b})};
}

/// Counts a block's pixels. The surface's shape around the sample is the rendered one.
void measure(const RgbdFrame& frame, const RasterImage& image, const cv::Point& rendered_center, int size,
             int step, const ColorModel& colors, double max_distance, Block* block) {
  const cv::Point& center = block->center;
  const Offsets columns = offsetsInside(rendered_center.x, center.x, size, frame.depth.cols);
  const Offsets rows = offsetsInside(rendered_center.y, center.y, size, frame.depth.rows);
  const auto nearer_by = static_cast<float>(block->predicted) - image.depth(rendered_center);
  const auto gate = static_cast<float>(max_distance);
  int measured = 0, agreeing = 0, nearer = 0, farther = 0;
  float sum = 0.0f;
  for (int j = rows.first; j < rows.end; j += step) {
    const float* rendered = image.depth[rendered_center.y + j] + rendered_center.x;
    const float* depth = frame.depth[center.y + j] + center.x;
    const cv::Vec3b* color = frame.color[center.y + j] + center.x;
    for (int i = columns.first; i < columns.end; i += step) {
      if (rendered[i] <= 0.0f || depth[i] <= 0.0f) continue;
      ++measured;
      const float difference = depth[i] - rendered[i] - nearer_by;
      if (difference > gate) {
        ++farther;
      } else if (difference < -gate || !colors.belongs(color[i])) {
        ++nearer;
      } else {
        ++agreeing;
        sum += difference;
      }
    }
  }
  if (measured == 0) return;
  if (agreeing > 0) block->difference = sum / static_cast<float>(agreeing);
  block->kind = BlockKind::kUnmeasured;
  if (2 * nearer > measured) {
    block->kind = BlockKind::kOccluded;
    block->difference = frame.depth(block->center) - block->predicted;
  } else if (2 * farther > measured) {
    block->kind = BlockKind::kAbsent;
  } else if (2 * agreeing > measured) {
    block->kind = BlockKind::kAgrees;
  }
}

/// The sample where the rigid motion takes it, and the frame's depth there.
Block observe(const RgbdFrame& frame, const RasterImage& image, const SurfaceSample& sample, int size,
              int step, const Eigen::Isometry3d& motion, const ColorModel& colors, double max_distance) {
  Block block;
  block.position = motion * sample.position;
  block.normal = motion.linear() * sample.normal;
  if (!(block.position.z() > 0.0)) return block;
  const Eigen::Vector2d pixel = frame.camera.project(block.position);
  if (!frame.camera.contains(pixel.x(), pixel.y())) return block;
  block.center = {cvRound(pixel.x()), cvRound(pixel.y())};
  const double slope = block.normal.dot(frame.camera.unproject(block.center.x, block.center.y, 1.0));
  if (-slope < 0.05) return block;
  block.predicted = block.normal.dot(block.position) / slope;
  measure(frame, image, sample.center, size, step, colors, max_distance, &block);
  return block;
}

double measuredDepth(const Block& block) { return block.predicted + block.difference; }

/// Whether an occluder's depth goes on from one block to the next: without a step, or as steeply as from the
/// block before. A blade seen from above is steep.
bool continues(const Block* before, const Block& occluder, const Block& next) {
  const double step = measuredDepth(next) - measuredDepth(occluder);
  if (std::abs(step) < kOccluderContinuity) return true;
  if (before == nullptr || before->kind != BlockKind::kOccluded) return false;
  const double last_step = measuredDepth(occluder) - measuredDepth(*before);
  return std::abs(step - last_step) < kOccluderContinuity;
}

/// Of two blocks of one smooth surface, whether the first lies in front of what the other shows to be there.
bool standsBefore(const Block& block, const Block& other) {
  return other.kind == BlockKind::kAgrees && std::abs(other.difference) < kOccluderStep &&
         block.difference <
             other.difference - std::max(kStandsOut, kSteepest * (block.position - other.position).norm()) &&
         std::abs(block.predicted - other.predicted) < kOccluderContinuity;
}

/// What stands out from the surface by a step is something before it, whatever its colour: a tool's handle,
/// nearer than the gate. The blocks at its border see both, so the second next counts as well.
void markSteps(const SurfaceSamples& surface, std::vector<Block>* blocks) {
  const cv::Mat1i& grid = surface.grid;
  const cv::Rect inside(cv::Point(), grid.size());
  std::vector<int> before;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.cols; ++column) {
      const int b = grid(row, column);
      if (b < 0 || (*blocks)[b].kind != BlockKind::kAgrees || (*blocks)[b].difference > -kStandsOut) continue;
      for (const cv::Point& way : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1),
                                   cv::Point(2, 0), cv::Point(-2, 0), cv::Point(0, 2), cv::Point(0, -2)}) {
        const cv::Point place = cv::Point(column, row) + way;
        const int other = inside.contains(place) ? grid(place) : -1;
        if (other < 0 || surface.samples[other].body != surface.samples[b].body) continue;
        if (!standsBefore((*blocks)[b], (*blocks)[other])) continue;
        before.push_back(b);
        break;
      }
    }
  }
  for (const int b : before) (*blocks)[b].kind = BlockKind::kOccluded;
}

/// The rest of a hand of which one end is recognised as an occluder.
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
      const bool goes_on = block.kind == BlockKind::kAgrees && block.difference < -kOccluderStep &&
                           continues(before, occluder, block);
      if (!goes_on) continue;
      block.kind = BlockKind::kOccluded;
      open.push_back(next);
    }
  }
}

}  // namespace

void downweightByNoise(double relative_noise, DepthAssociations* depth) {
  if (relative_noise <= kUsualNoise) return;
  const double scale = std::max(kLeastTrust, std::pow(kUsualNoise / relative_noise, 2));
  for (Association& association : depth->associations) association.weight *= scale;
}

const DepthAssociations& DepthAssociator::associate(const RgbdFrame& frame, const RasterImage& image,
                                                    const SurfaceSamples& surface,
                                                    const RigidMotions& motions, const ColorModel& colors,
                                                    int pixel_step) {
  const int step = std::min(pixel_step, surface.block_px);
  blocks_.clear();
  for (const SurfaceSample& sample : surface.samples) {
    blocks_.push_back(observe(frame, image, sample, surface.block_px, step, motions[sample.body], colors,
                              config_.max_distance_m));
  }
  markSteps(surface, &blocks_);
  growOccluders(surface.grid, &blocks_);
  found_.noise = pixel_step == 1 ? sampleDepthNoise(surface, blocks_, frame.camera.fx, &second_differences_) : DepthNoiseSample();

  found_.associations.clear();
  found_.visible_blocks = found_.occluded_blocks = found_.absent_blocks = 0;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Block& block = blocks_[i];
    if (block.kind == BlockKind::kUnmeasured) continue;
    ++found_.visible_blocks;
    found_.occluded_blocks += block.kind == BlockKind::kOccluded ? 1 : 0;
    found_.absent_blocks += block.kind == BlockKind::kAbsent ? 1 : 0;
    if (block.kind != BlockKind::kAgrees) continue;
    const double cosine = -block.normal.dot(block.position.normalized());
    if (cosine < kMostGrazing) continue;
    Association association;
    association.kind = TargetKind::kDepth;
    association.place = surface.samples[i].place;
    association.body = surface.samples[i].body;
    association.predicted = block.position;
    association.measured =
        frame.camera.unproject(block.center.x, block.center.y, block.predicted + block.difference);
    association.normal = block.normal;
    const double width = surface.block_px * block.position.z() / (frame.camera.fx * volume_edge_m_);
    const double weight = config_.weight * width * width / cosine;  // per area of surface, not of picture
    association.weight = std::min(weight, kLargestTargetWeight);
    found_.associations.push_back(association);
  }
  return found_;
}

}  // namespace softbody
