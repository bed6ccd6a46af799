#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody::scanning {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// p -> R(omega) p + t with (t, omega) [m, rad].
inline Eigen::Isometry3d smallMotion(const Vector6& x) { return rigidMotion(x.tail<3>(), x.head<3>()); }

/// smallMotion(x) T with a rotation that is one to the last digit: in a chain of poses, rounding would grow
/// with each inverse.
inline Eigen::Isometry3d moved(const Vector6& x, const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = smallMotion(x) * T;
  result.linear() = Eigen::Quaterniond(result.linear()).normalized().toRotationMatrix();
  return result;
}

/// The inverse of smallMotion().
inline Vector6 motionVector(const Eigen::Isometry3d& T) {
  const Eigen::AngleAxisd turn(T.linear());
  Vector6 x;
  x << T.translation(), turn.angle() * turn.axis();
  return x;
}

/// A small motion in frame b, seen in frame a: T smallMotion(x) T^-1 = smallMotion(movedBy(T) x).
inline PoseCovariance movedBy(const Eigen::Isometry3d& T) {
  PoseCovariance A = PoseCovariance::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  A.topRightCorner<3, 3>() = crossMatrix(T.translation()) * T.linear();
  return A;
}

}  // namespace softbody::scanning
