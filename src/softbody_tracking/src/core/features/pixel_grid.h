#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/pinhole.h"

namespace softbody {

/// Points of an image in square cells, to find neighbours.
class PixelGrid {
 public:
  PixelGrid(const Pinhole& camera, int cell_px)
      : cell_(cell_px),
        columns_(camera.width / cell_px + 1),
        rows_(camera.height / cell_px + 1),
        cells_(static_cast<std::size_t>(columns_) * rows_) {}

  void insert(const cv::Point2f& pixel, int index) {
    cells_[cellIndex(column(pixel.x), row(pixel.y))].push_back(index);
  }

  /// Calls visit(index) for each point in the 3x3 cells around a pixel.
  template <typename Visitor>
  void around(double u, double v, Visitor visit) const {
    const int x = column(u), y = row(v);
    for (int j = std::max(0, y - 1); j <= std::min(rows_ - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(columns_ - 1, x + 1); ++i) {
        for (int index : cells_[cellIndex(i, j)]) visit(index);
      }
    }
  }

  const std::vector<std::vector<int>>& cells() const { return cells_; }

 private:
  int column(double u) const { return std::clamp(static_cast<int>(u) / cell_, 0, columns_ - 1); }
  int row(double v) const { return std::clamp(static_cast<int>(v) / cell_, 0, rows_ - 1); }
  std::size_t cellIndex(int x, int y) const { return static_cast<std::size_t>(y) * columns_ + x; }

  int cell_, columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

}  // namespace softbody
