#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "softbody_common/geometry/pinhole.h"

namespace softbody::scanning {

/// What a frame is recognised by: corners with ORB descriptors (Rublee et al. 2011).
struct FrameLook {
  Pinhole camera;
  cv::Mat descriptors;
  std::vector<cv::Point2f> pixels;
  std::vector<cv::Point3f> points;  ///< camera frame [m]; z = 0: no depth
};

FrameLook lookOf(const Pinhole& camera, const cv::Mat3b& color, const cv::Mat1f& depth);

/// The rough pose T_b_a by descriptors and RANSAC; nothing if too few agree.
std::optional<Eigen::Isometry3d> recognise(const FrameLook& a, const FrameLook& b);

}  // namespace softbody::scanning
