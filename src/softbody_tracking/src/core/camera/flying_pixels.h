#pragma once

#include <opencv2/core.hpp>

namespace softbody {

/// Removes flying pixels: false depths that a sensor gives between two surfaces. Two pixels are near each
/// other if their depths differ by less than ratio * z, or sqrt(2) times that along a diagonal. A pixel is
/// kept if
/// - at least two of its eight neighbours are near it, as along a thin wire; and
/// - it is not a step. A pixel is a step if two opposite neighbours (row, column or diagonal) are not near,
///   and if one is closer to the camera and the other farther away. A real object before the background has
///   only neighbours that are farther away.
class FlyingPixelFilter {
 public:
  explicit FlyingPixelFilter(double ratio) : ratio_(static_cast<float>(ratio)) {}

  /// @param depth [m]; 0: no depth. @param result its memory is reused if it has the right size.
  void apply(const cv::Mat1f& depth, cv::Mat1f* result);

 private:
  float ratio_;
  cv::Mat1f padded_;
};

}  // namespace softbody
