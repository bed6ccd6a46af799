#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "softbody_common/geometry/pinhole.h"

namespace softbody {

/// Depth of one camera as another camera sees it. Each pixel is a small square that faces the camera, so the
/// result has no gaps where the other camera has more pixels. Of several surfaces the nearest is kept.
/// @param depth z in the camera `from` [m]; NaN or 0: no depth. @param T_to_from pose of `from` in `to`.
/// @return z in the camera `to` [m], of its size; NaN: no depth.
/// @throw std::invalid_argument if depth does not have from's size.
cv::Mat1f registeredDepth(const cv::Mat1f& depth, const Pinhole& from, const Eigen::Isometry3d& T_to_from,
                          const Pinhole& to);

}  // namespace softbody
