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
// Cells that are looked at, each way.
constexpr int kLooks = 3;

/// Falls smoothly from 1 at 0 to 0 at 1 (biweight kernel).
float kernel(float squared) { return squared < 1.0f ? (1.0f - squared) * (1.0f - squared) : 0.0f; }

}  // namespace

double LabelMemory::logOdds(const cv::Point& center, float depth_m, int reach_px) const {
  if (depth.empty()) return 0.0;
  const cv::Point own(cvFloor(static_cast<double>(center.x - origin.x) / size_px),
                      cvFloor(static_cast<double>(center.y - origin.y) / size_px));
  const int reach = std::max(1, reach_px / size_px), step = std::max(1, reach / kLooks);
  const cv::Rect all({}, depth.size());
  float on_body = kUnsure, on_occluder = kUnsure;
  for (int j = -kLooks * step; j <= kLooks * step; j += step) {
    for (int i = -kLooks * step; i <= kLooks * step; i += step) {
      const cv::Point place = own + cv::Point(i, j);
      if (!all.contains(place) || depth(place) <= 0.0f) continue;
      const float farther = (depth(place) - depth_m) / kSameSurface;
      const auto cells = static_cast<float>(i * i + j * j);
      const float weight = kernel(farther * farther) * kernel(cells / static_cast<float>(reach * reach));
      on_body += weight * body(place);
      on_occluder += weight * (1.0f - body(place));
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
