#include "labels/label_memory.h"

#include <algorithm>
#include <cmath>

#include "labels/label_cells.h"

namespace softbody {
namespace {

// A surface seen in two frames differs in depth by about this [m]: motion between them, and slope.
constexpr float kSameSurface = 0.016f;
// Cells of each kind that are always added: few cells of the last frame say little.
constexpr float kUnsure = 0.5f;

/// Falls smoothly from 1 at 0 to 0 at 1 (biweight kernel).
float kernel(float squared) { return squared < 1.0f ? (1.0f - squared) * (1.0f - squared) : 0.0f; }

}  // namespace

LabelRecall::LabelRecall(const LabelMemory& last, int reach_px) : last_(last) {
  const int reach = std::max(1, reach_px / last.size_px);
  step_ = std::max(1, reach / kLooks);
  auto weight = weights_.begin();
  for (int j = -kLooks; j <= kLooks; ++j)
    for (int i = -kLooks; i <= kLooks; ++i)
      *weight++ =
          kernel(static_cast<float>(step_ * step_ * (i * i + j * j)) / static_cast<float>(reach * reach));
}

double LabelRecall::logOdds(const cv::Point& center, float depth_m) const {
  if (last_.depth.empty()) return 0.0;
  const cv::Point own(cvFloor(static_cast<double>(center.x - last_.origin.x) / last_.size_px),
                      cvFloor(static_cast<double>(center.y - last_.origin.y) / last_.size_px));
  float on_body = kUnsure, on_occluder = kUnsure;
  for (int j = 0; j < kSide; ++j) {
    const int v = own.y + (j - kLooks) * step_;
    if (v < 0 || v >= last_.depth.rows) continue;
    const float *depth = last_.depth[v], *body = last_.body[v], *near = weights_.data() + j * kSide;
    for (int i = 0; i < kSide; ++i) {
      const int u = own.x + (i - kLooks) * step_;
      if (u < 0 || u >= last_.depth.cols || depth[u] <= 0.0f) continue;
      const float farther = (depth[u] - depth_m) / kSameSurface;
      const float weight = kernel(farther * farther) * near[i];
      on_body += weight * body[u];
      on_occluder += weight * (1.0f - body[u]);
    }
  }
  return std::log(on_body / on_occluder);
}

LabelMemory memoryOf(const LabelCells& cells) {
  LabelMemory memory{cells.size_px, cells.origin, cv::Mat1f(cells.grid, 0.0f), cv::Mat1f(cells.grid, 0.0f)};
  for (cv::Point place(0, 0); place.y < cells.grid.height; ++place.y) {
    for (place.x = 0; place.x < cells.grid.width; ++place.x) {
      const LabelCell& cell = cells.at(place);
      if (!cell.shows_front) continue;
      memory.depth(place) = cell.measured();
      memory.body(place) = cell.body;
    }
  }
  return memory;
}

}  // namespace softbody
