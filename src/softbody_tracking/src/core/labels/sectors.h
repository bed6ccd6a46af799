#pragma once

#include <cstdlib>
#include <opencv2/core.hpp>

namespace softbody {

/// Eight sectors around the middle of a box, as wide in each as the box is: what lies on one side of the body
/// says nothing about the other sides.
class Sectors {
 public:
  static constexpr int kCount = 8;  // each has some hundred pixels of the margin

  /// @param box of the rendered body [px].
  explicit Sectors(const cv::Rect& box)
      : middle_(2 * box.x + box.width, 2 * box.y + box.height), size_(box.width, box.height) {}

  /// Whether all pixels of a box are in the sector of its first one: sectors are convex.
  bool areOne(const cv::Rect& pixels) const {
    const int first = of(pixels.x, pixels.y), u = pixels.br().x - 1, v = pixels.br().y - 1;
    return of(u, pixels.y) == first && of(pixels.x, v) == first && of(u, v) == first;
  }

  int of(int u, int v) const {
    const int x = (2 * u - middle_.x) * size_.height, y = (2 * v - middle_.y) * size_.width;
    return (x < 0 ? 4 : 0) + (y < 0 ? 2 : 0) + (std::abs(x) < std::abs(y) ? 1 : 0);
  }

 private:
  cv::Point middle_;  ///< [half pixels]
  cv::Size size_;
};

}  // namespace softbody
