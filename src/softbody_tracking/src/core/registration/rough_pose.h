#pragma once

#include <Eigen/Geometry>

#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// Where the body is said to be.
struct RoughPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< rest frame in the camera frame
  double std_m = 0.0;    ///< standard deviation of the body's place along each axis
  double std_rad = 0.0;  ///< of its turn
};

/// A pose with the standard deviations of `config`.
RoughPose roughPose(const Eigen::Isometry3d& pose, const RegistrationConfig& config);

/// How far a pose is from a rough one, in standard deviations.
struct PoseDeviation {
  double shift = 0.0;
  double turn = 0.0;
};

/// @param center of the body, rest frame [m].
PoseDeviation deviationFrom(const RoughPose& rough, const Eigen::Isometry3d& pose,
                            const Eigen::Vector3d& center);

/// Whether a pose is not farther from a rough one than three standard deviations.
bool isNear(const RoughPose& rough, const Eigen::Isometry3d& pose, const Eigen::Vector3d& center);

}  // namespace softbody
