#include "fusion/depth_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody::scanning {
namespace {

constexpr int kCell_px = 16;
constexpr float kFar = std::numeric_limits<float>::infinity();

int cellsIn(int pixels) { return (pixels + kCell_px - 1) / kCell_px; }

}  // namespace

DepthRange::DepthRange(const DepthView& view)
    : camera_(view.camera),
      cells_(cellsIn(view.depth.rows), cellsIn(view.depth.cols), cv::Vec2f(kFar, 0.0f)) {
  for (int row = 0; row < view.depth.rows; ++row) {
    for (int column = 0; column < view.depth.cols; ++column) {
      cv::Vec2f& cell = cells_(row / kCell_px, column / kCell_px);
      const float depth = view.depth(row, column);
      cell[0] = std::min(cell[0], view.nearest(row, column));
      cell[1] = std::max(cell[1], depth > 0.0f ? depth : kFar);
    }
  }
}

BlockSight DepthRange::sightOf(const Eigen::Vector3d& center, double radius, double reach) const {
  const double near_z = center.z() - radius;
  if (near_z < 0.05) return center.z() + radius < 0.05 ? BlockSight::kNone : BlockSight::kMixed;
  const double grown = std::max(camera_.fx, camera_.fy) * radius / near_z + 1.0;
  const Eigen::Vector2d middle = camera_.project(center);
  const Eigen::Array2d low = middle.array() - grown, high = middle.array() + grown;
  if ((high < 0.0).any() || low.x() > camera_.width - 1 || low.y() > camera_.height - 1)
    return BlockSight::kNone;
  const bool inside = (low >= 0.0).all() && high.x() <= camera_.width - 1 && high.y() <= camera_.height - 1;
  if (!inside) return BlockSight::kMixed;
  float least = kFar, largest = 0.0f;
  for (int row = static_cast<int>(low.y()) / kCell_px; row <= static_cast<int>(high.y()) / kCell_px; ++row) {
    for (int column = static_cast<int>(low.x()) / kCell_px; column <= static_cast<int>(high.x()) / kCell_px;
         ++column) {
      least = std::min(least, cells_(row, column)[0]);
      largest = std::max(largest, cells_(row, column)[1]);
    }
  }
  if (least > center.z() + radius + reach) return BlockSight::kEmpty;
  if (largest < center.z() - radius - reach) return BlockSight::kHidden;
  return BlockSight::kMixed;
}

}  // namespace softbody::scanning
