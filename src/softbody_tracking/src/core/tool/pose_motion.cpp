#include "tool/pose_motion.h"

#include <Eigen/Cholesky>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Assumed for a tool in a hand.
constexpr double kSpeed_m_s = 0.5;          // [m/s] initial standard deviation of the velocity
constexpr double kTurnRate_rad_s = 3.0;     // [rad/s] initial standard deviation of the angular velocity
constexpr double kAcceleration_m_s2 = 3.0;  // [m/s^2] standard deviation over one frame
constexpr double kAngularAcceleration_rad_s2 = 20.0;  // [rad/s^2] standard deviation over one frame
constexpr double kFrameRate_hz = 30.0;                // [Hz] turns those variances into spectral densities

Vector6 perAxis(double linear, double angular) {
  Vector6 values;
  values << linear, linear, linear, angular, angular, angular;
  return values;
}

}  // namespace

Eigen::Isometry3d movedPose(const Eigen::Isometry3d& T, const Vector6& move) {
  Eigen::Isometry3d moved = T;
  moved.linear() = rotationBy(move.tail<3>()) * T.linear();
  moved.translation() += move.head<3>();
  return moved;
}

Vector6 poseDifference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
  Vector6 move;
  move << to.translation() - from.translation(), turn.angle() * turn.axis();
  return move;
}

PoseMotion::PoseMotion(const Eigen::Isometry3d& pose, const PoseCovariance& covariance, Nanoseconds stamp)
    : pose_(pose), stamp_(stamp) {
  covariance_.topLeftCorner<6, 6>() = covariance;
  covariance_.bottomRightCorner<6, 6>().diagonal() = perAxis(kSpeed_m_s, kTurnRate_rad_s).array().square();
}

Eigen::Isometry3d PoseMotion::poseAt(double dt) const { return movedPose(pose_, dt * velocity_); }

PoseMotion::Covariance PoseMotion::covarianceAt(double dt) const {
  Covariance F = Covariance::Identity();
  F.topRightCorner<6, 6>().diagonal().setConstant(dt);
  Covariance predicted = F * covariance_ * F.transpose();
  const Vector6 q = perAxis(kAcceleration_m_s2, kAngularAcceleration_rad_s2).array().square() / kFrameRate_hz;
  predicted.topLeftCorner<6, 6>().diagonal() += dt * dt * dt / 3.0 * q;
  predicted.topRightCorner<6, 6>().diagonal() += dt * dt / 2.0 * q;
  predicted.bottomLeftCorner<6, 6>().diagonal() += dt * dt / 2.0 * q;
  predicted.bottomRightCorner<6, 6>().diagonal() += dt * q;
  return predicted;
}

PoseMotion::Prediction PoseMotion::predict(Nanoseconds stamp) const {
  const double dt = seconds(stamp - stamp_);
  return {poseAt(dt), covarianceAt(dt).topLeftCorner<6, 6>()};
}

void PoseMotion::update(const Eigen::Isometry3d& pose, const PoseCovariance& covariance, Nanoseconds stamp) {
  const double dt = seconds(stamp - stamp_);
  const Covariance P = covarianceAt(dt);
  const Eigen::Isometry3d predicted = poseAt(dt);
  const PoseCovariance S = P.topLeftCorner<6, 6>() + covariance;
  const Eigen::Matrix<double, 12, 6> K = S.ldlt().solve(P.topRows<6>()).transpose();
  const Eigen::Matrix<double, 12, 1> step = K * poseDifference(predicted, pose);
  pose_ = movedPose(predicted, step.head<6>());
  velocity_ += step.tail<6>();
  covariance_ = P - K * P.topRows<6>();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  stamp_ = stamp;
}

}  // namespace softbody
