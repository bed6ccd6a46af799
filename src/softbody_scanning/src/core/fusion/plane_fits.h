#pragma once

#include <opencv2/core.hpp>

namespace softbody::scanning {

/// Local fits of inverse depth q = a (u - u0) + b (v - v0) + c in square windows around all pixels (u0, v0).
struct PlaneFits {
  cv::Mat3f coefficients;  ///< a, b, c [1/m per px, 1/m]; zero: too few pixels with depth
  cv::Mat1f scatter;       ///< rms residual [1/m]
};

/// @param depth z [m]; 0: none.
PlaneFits fitPlanes(const cv::Mat1f& depth);

}  // namespace softbody::scanning
