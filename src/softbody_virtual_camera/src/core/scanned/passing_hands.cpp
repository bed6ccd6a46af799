#include "scanned/passing_hands.h"

#include <Eigen/Dense>
#include <cmath>

#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kAway = 1.3, kRamp = 0.9;  // [m], [s]

Actor handActor() { return {hand(), skinTexture(), 2.0e-3}; }

/// From the right of the image, on half of the way to the body.
PassingHand handBeforeCamera(const CameraWay& way, double begin) {
  constexpr double kHold = 0.3, kBeyond = 0.03;  // [s], [m]
  const Eigen::Isometry3d T_world_middle = steadyCamera(way, begin + kRamp) *
                                           Eigen::Translation3d(-kBeyond, 0.0, 0.5 * way.distance_m) *
                                           Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());
  return {handActor(), [=](double t) -> Eigen::Isometry3d {
            const double away = kAway * (1.0 - plateau(t, {begin, kRamp, kHold}));
            return T_world_middle * Eigen::Translation3d(-away, 0.0, 0.0);
          }};
}

/// The fingers come down from above; the arm comes from outside.
PassingHand handBesideBody(const Eigen::Vector3d& beside, double begin) {
  constexpr double kHold = 1.2, kTilt = 0.5;  // [s], [rad]
  const double outward = std::atan2(beside.y(), beside.x());
  const Eigen::Isometry3d T_world_turned = Eigen::Translation3d(beside) *
                                           Eigen::AngleAxisd(outward + M_PI, Eigen::Vector3d::UnitZ()) *
                                           Eigen::AngleAxisd(kTilt, Eigen::Vector3d::UnitY());
  const double lowest = transformed(T_world_turned, hand().vertices).col(2).minCoeff() - beside.z();
  return {handActor(), [=](double t) -> Eigen::Isometry3d {
            const double away = kAway * (1.0 - plateau(t, {begin, kRamp, kHold}));
            return Eigen::Translation3d(0.0, 0.0, -lowest) * T_world_turned *
                   Eigen::Translation3d(-away, 0.0, 0.0);
          }};
}

}  // namespace

std::vector<PassingHand> passingHands(const CameraWay& way, const Eigen::Vector3d& beside) {
  return {handBeforeCamera(way, 3.0), handBeforeCamera(way, 7.5), handBesideBody(beside, 10.5),
          handBeforeCamera(way, 15.5)};
}

}  // namespace softbody::virtual_camera
