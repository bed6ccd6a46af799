#pragma once

#include <Eigen/Geometry>

#include "softbody_common/types.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// T moved by a small translation [m] and rotation [rad], both along the axes of the frame that T leads to.
Eigen::Isometry3d movedPose(const Eigen::Isometry3d& T, const Eigen::Matrix<double, 6, 1>& move);
/// The move from one pose to another: movedPose(from, poseDifference(from, to)) = to.
Eigen::Matrix<double, 6, 1> poseDifference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);

/// A Kalman filter over pose and velocity that predicts a hand-held tool; acceleration is white noise.
class PoseMotion {
 public:
  struct Prediction {
    Eigen::Isometry3d pose;
    PoseCovariance covariance;
  };

  /// At rest, with a hand's velocities.
  PoseMotion(const Eigen::Isometry3d& pose, const PoseCovariance& covariance, Nanoseconds stamp);

  Prediction predict(Nanoseconds stamp) const;
  /// Takes in a pose measured at a stamp that is not before the last one.
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
