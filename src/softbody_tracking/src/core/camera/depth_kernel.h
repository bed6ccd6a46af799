#pragma once

#include <limits>
#include <opencv2/core.hpp>
#include <vector>

namespace softbody {

/// Which raw depths are kept.
struct DepthLimits {
  float unit_m = 1.0f;  ///< of the raw depth
  float min_m = 0.0f, max_m = std::numeric_limits<float>::max();
  float jump_ratio = 0.0f;  ///< of neighbouring pixels on one surface; 0: flying pixels are kept
};

/// Makes metres from raw depth in one pass over the image, and removes flying pixels: false depths that a
/// sensor gives between two surfaces. Two pixels are near each other if their depths differ by at most
/// jump_ratio * z, or 1.5 times that along a diagonal. A pixel is kept if
/// - at least two of its eight neighbours are near it, as along a thin wire; and
/// - it is not a step. A pixel is a step if two opposite neighbours (row, column or diagonal) are not near,
///   and if one is closer to the camera and the other farther away. A real object before the background has
///   only neighbours that are farther away.
/// Vectors of any width give the same bits.
class DepthCleaner {
 public:
  /// @param raw CV_16UC1 or CV_32FC1; 0, NaN and infinity: no depth.
  /// @param clean z [m]; NaN: no depth. Its memory is used if it has the size of raw.
  void clean(const cv::Mat& raw, const DepthLimits& limits, cv::Mat1f* clean);

 private:
  std::vector<float> rows_;  ///< three rows in metres with a border of zeros
};

}  // namespace softbody
