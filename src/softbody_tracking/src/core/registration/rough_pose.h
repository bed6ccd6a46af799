#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "agreement/pose_cost.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// Where the body is said to be.
struct RoughPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< rest frame in the camera frame
  double std_m = 0.0;    ///< standard deviation of the body's place along each axis
  double std_rad = 0.0;  ///< of its turn
};

/// A pose with the standard deviations of `config`.
inline RoughPose roughPose(const Eigen::Isometry3d& pose, const RegistrationConfig& config) {
  return {pose, config.pose_std_m, config.pose_std_deg * M_PI / 180.0};
}

/// How far a pose is from a rough one, in standard deviations.
struct PoseDeviation {
  double shift = 0.0;
  double turn = 0.0;
};

/// @param center of the body, rest frame [m].
inline PoseDeviation deviationFrom(const RoughPose& rough, const Eigen::Isometry3d& pose,
                                   const Eigen::Vector3d& center) {
  const Eigen::AngleAxisd turn(pose.linear().transpose() * rough.pose.linear());
  return {(pose * center - rough.pose * center).norm() / rough.std_m, turn.angle() / rough.std_rad};
}

/// Whether a pose is not farther from a rough one than three standard deviations.
inline bool isNear(const RoughPose& rough, const Eigen::Isometry3d& pose, const Eigen::Vector3d& center) {
  const PoseDeviation off = deviationFrom(rough, pose, center);
  return off.shift <= kDoubt && off.turn <= kDoubt;
}

}  // namespace softbody
