#include "scanned/hand_held.h"

#include <Eigen/Dense>
#include <cmath>

#include "motion/motion_profiles.h"
#include "softbody_common/statistics/random.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;
constexpr double kLow = 30.0 * kRadians, kHigh = 60.0 * kRadians;  // above the table

/// Optical frame in the world; x is level.
Eigen::Isometry3d cameraAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << right, forward.cross(right), forward;
  T_world_camera.translation() = eye;
  return T_world_camera;
}

Eigen::Isometry3d cameraRound(const CameraWay& way, double azimuth, double elevation, double distance_m) {
  const Eigen::Vector3d out(std::cos(elevation) * std::sin(azimuth), -std::cos(elevation) * std::cos(azimuth),
                            std::sin(elevation));
  return cameraAt(way.target + distance_m * out, way.target);
}

/// Between -1 and 1; a sum of sines without a common period, from 3 to 8 Hz.
double tremor(std::uint64_t seed, double t) {
  constexpr double kHertz[] = {3.1, 4.73, 7.37}, kShares[] = {0.5, 0.3, 0.2};
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 3; ++i)
    sum += kShares[i] * std::sin(2.0 * M_PI * (kHertz[i] * t + unit(hash(seed, i))));
  return sum;
}

Eigen::Vector3d trembling(std::uint64_t seed, double t) {
  return {tremor(hash(seed, 1), t), tremor(hash(seed, 2), t), tremor(hash(seed, 3), t)};
}

/// Of the camera, in its own frame [m]. The steepest slope of the step is pi / 2 times its mean slope.
Eigen::Vector3d jerked(double t) {
  constexpr double kSpeed = 0.3, kPush = 0.15, kReturn = 0.8;  // [m/s], [s]
  constexpr double kFar = kSpeed * kPush * 2.0 / M_PI, kTimes[] = {2.3, 6.1, 9.8, 13.4, 17.2};
  Eigen::Vector3d aside = Eigen::Vector3d::Zero();
  double turn = 0.4;
  for (const double begin : kTimes) {
    const double share = smoothStep((t - begin) / kPush) - smoothStep((t - begin - kPush) / kReturn);
    aside += kFar * share * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0.0);
    turn += 1.3;
  }
  return aside;
}

}  // namespace

Eigen::Isometry3d steadyCamera(const CameraWay& way, double t) {
  constexpr double kRound = 375.0 * kRadians, kFarther = 0.05, kRoll = 4.0 * kRadians;
  constexpr int kWaves = 3;  // whole, so that the round closes
  const double azimuth = kRound * t / way.duration_s;
  const double wave = std::cos(kWaves * azimuth);
  return cameraRound(way, azimuth, 0.5 * (kLow + kHigh) - 0.5 * (kHigh - kLow) * wave,
                     way.distance_m * (1.0 + kFarther * std::sin(azimuth))) *
         Eigen::AngleAxisd(kRoll * std::sin(2.0 * azimuth), Eigen::Vector3d::UnitZ());
}

Eigen::Isometry3d walkingCamera(const CameraWay& way, double t) {
  constexpr double kShift = 2.0e-3, kTurn = 0.5 * kRadians;  // [m]
  const Eigen::Vector3d shift = kShift * trembling(hash(way.seed, 1), t);
  const Eigen::Vector3d turn = kTurn * trembling(hash(way.seed, 2), t);
  const Eigen::Vector3d aside = way.jerks ? jerked(t) : Eigen::Vector3d::Zero();
  return steadyCamera(way, t) * Eigen::Translation3d(shift + aside) *
         Eigen::AngleAxisd(turn.norm(), turn.normalized());
}

Eigen::Isometry3d standingCamera(const CameraWay& way, double t) {
  constexpr double kLift = 0.1;  // of the duration
  const double lifted = smoothStep((t / way.duration_s - 0.5) / kLift + 0.5);
  return cameraRound(way, 0.0, kLow + (kHigh - kLow) * lifted, way.distance_m);
}

}  // namespace softbody::virtual_camera
