#pragma once

#include <string>

#include "markerless/relative_pose.h"

namespace softbody::scanning {

/// Why a relative pose is not sure; empty: it is. @param depth_m of what is looked at.
std::string doubtAbout(const RelativePose& pose, double depth_m, double inverse_depth_std);

/// Median depth of a frame [m]; 0: none.
double medianDepth(const cv::Mat1f& depth);

/// Covariance of the motion of a point on the optical axis at this depth.
Eigen::Matrix3d covarianceAt(const PoseCovariance& covariance, double depth_m);

}  // namespace softbody::scanning
