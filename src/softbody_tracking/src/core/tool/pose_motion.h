#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// T_a_b moved by a translation [m] and then a rotation vector [rad], both in the axes of frame a.
Eigen::Isometry3d movedPose(const Eigen::Isometry3d& T, const Eigen::Matrix<double, 6, 1>& move);
/// The move that takes one pose to another: movedPose(from, poseDifference(from, to)) = to.
Eigen::Matrix<double, 6, 1> poseDifference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);

/// Kalman filter over the pose and velocity of a hand-held tool, with white-noise acceleration.
class PoseMotion {
 public:
  struct Prediction {
    Eigen::Isometry3d pose;
    PoseCovariance covariance;
  };

  /// Starts at rest, with the uncertainty of a hand's velocity.
  PoseMotion(const Eigen::Isometry3d& pose, const PoseCovariance& covariance, Nanoseconds stamp);

  Prediction predict(Nanoseconds stamp) const;
  /// Measurement update. @param stamp not before the last one.
  void update(const Eigen::Isometry3d& pose, const PoseCovariance& covariance, Nanoseconds stamp);
  /// Of the last update.
  Nanoseconds stamp() const { return stamp_; }

 private:
  using Covariance = Eigen::Matrix<double, 12, 12>;
  Eigen::Isometry3d poseAt(double dt) const;
  Covariance covarianceAt(double dt) const;

  Eigen::Isometry3d pose_;
  Eigen::Matrix<double, 6, 1> velocity_ = Eigen::Matrix<double, 6, 1>::Zero();  ///< [m/s], [rad/s]
  Covariance covariance_ = Covariance::Zero();
  Nanoseconds stamp_;
};

}  // namespace softbody
