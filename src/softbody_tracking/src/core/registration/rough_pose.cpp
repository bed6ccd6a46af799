#include "registration/rough_pose.h"

#include <cmath>

#include "registration/pose_cost.h"

namespace softbody {

RoughPose roughPose(const Eigen::Isometry3d& pose, const RegistrationConfig& config) {
  return {pose, config.pose_std_m, config.pose_std_deg * M_PI / 180.0};
}

PoseDeviation deviationFrom(const RoughPose& rough, const Eigen::Isometry3d& pose,
                            const Eigen::Vector3d& center) {
  const Eigen::AngleAxisd turn(pose.linear().transpose() * rough.pose.linear());
  return {(pose * center - rough.pose * center).norm() / rough.std_m, turn.angle() / rough.std_rad};
}

bool isNear(const RoughPose& rough, const Eigen::Isometry3d& pose, const Eigen::Vector3d& center) {
  const PoseDeviation off = deviationFrom(rough, pose, center);
  return off.shift <= kDoubt && off.turn <= kDoubt;
}

}  // namespace softbody
