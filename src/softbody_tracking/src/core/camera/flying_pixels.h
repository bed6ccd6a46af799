#pragma once

#include <opencv2/core.hpp>

namespace softbody {

/// Removes depths that sensors invent between two surfaces. With "near" meaning within ratio * z (half as
/// much again along a diagonal, whose pixels are further apart), a pixel stays if
/// - at least two of its eight neighbours are near: a thin wire has them along itself, a stray pixel has not;
/// and
/// - along row, column and diagonals it is no step between a nearer and a farther neighbour neither of which
/// is near:
///   a ramp across an edge. An object in front of the background has farther neighbours on both sides.
class FlyingPixelFilter {
 public:
  explicit FlyingPixelFilter(double ratio) : ratio_(static_cast<float>(ratio)) {}

  /// @param depth [m], 0: none. @param result its memory is reused when the size fits.
  void apply(const cv::Mat1f& depth, cv::Mat1f* result);

 private:
  float ratio_;
  cv::Mat1f padded_;
};

}  // namespace softbody
