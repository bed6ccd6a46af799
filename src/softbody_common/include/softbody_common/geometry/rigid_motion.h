#pragma once

#include <Eigen/Geometry>

namespace softbody {

/// The matrix of v -> a x v.
inline Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

/// How a small turn [rad], then a shift, about a centre move a point. @param arm from the centre to the
/// point.
inline Eigen::Matrix<double, 3, 6> motionJacobian(const Eigen::Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> J;
  J << 0.0, arm.z(), -arm.y(), 1.0, 0.0, 0.0,  //
      -arm.z(), 0.0, arm.x(), 0.0, 1.0, 0.0,   //
      arm.y(), -arm.x(), 0.0, 0.0, 0.0, 1.0;
  return J;
}

/// The turn about an axis by the axis' length [rad].
inline Eigen::Matrix3d rotationBy(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

/// A turn about a centre, then a shift.
inline Eigen::Isometry3d rigidMotion(const Eigen::Vector3d& turn, const Eigen::Vector3d& shift,
                                     const Eigen::Vector3d& center = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = rotationBy(turn);
  motion.translation() = center + shift - motion.linear() * center;
  return motion;
}

}  // namespace softbody
