#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// A model frame on the table, and the space above it that is looked at.
struct ModelFrame {
  Eigen::Isometry3d T_model_fixed = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox3d region;  ///< model frame [m]
};

/// Finds the table and what the camera went round, for a camera whose poses are known in any fixed frame. The
/// table is the plane with most depth (RANSAC, Fischler and Bolles 1981) below all cameras; the origin is
/// below the point that is nearest to all optical axes.
/// @param frames with T_camera_model from the fixed frame. @param inverse_depth_std see
/// measureInverseDepthNoise().
/// @throw std::invalid_argument if there is no such plane, or the camera did not move around anything.
ModelFrame findModelFrame(const std::vector<KeyFrame>& frames, double inverse_depth_std);

}  // namespace softbody::scanning
