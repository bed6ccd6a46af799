#include "scenes/plays.h"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "motion/deformations.h"
#include "motion/motion_profiles.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLargestCurvature = 7.0;  // [1/m]
constexpr double kLargestTwist = 7.0;      // [rad/m]
constexpr double kLargestStrain = 0.3;

Play stretching(const std::string& name, const Stage& stage, double strain) {
  Play play;
  play.name = name;
  const double half_length = stage.actors.at(0).rest.vertices.col(0).cwiseAbs().maxCoeff();
  play.deformation = [=](const Eigen::Vector3d& rest, double t) {
    return stretch(rest, {strain * plateau(t, {0.5, 1.5, 1.0}), half_length});
  };
  return play;
}

}  // namespace

Play stillPlay(const Stage&) {
  Play play;
  play.name = "still";
  return play;
}

Play bendPlay(const Stage&) {
  Play play;
  play.name = "bend";
  play.deformation = [](const Eigen::Vector3d& rest, double t) {
    return bend(rest, kLargestCurvature * swing(t));
  };
  return play;
}

Play fastPlay(const Stage& stage) {
  constexpr double kSpeed = 0.7;                                                                 // [m/s]
  constexpr double kBending = 1.0 * 2.0 * kPi, kSwinging = 1.25 * 2.0 * kPi;                     // [rad/s]
  const Eigen::Vector3d way = kSpeed / kSwinging * Eigen::Vector3d(0.9, 0.0, 0.4).normalized();  // [m]
  const auto share = [](double t) { return plateau(t, {0.5, 0.5, 3.0}); };
  Play play;
  play.name = "fast";
  play.deformation = [=](const Eigen::Vector3d& rest, double t) {
    return bend(rest, kLargestCurvature * share(t) * std::sin(kBending * (t - 0.5)));
  };
  play.T_camera_body = [=, start = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    return Eigen::Translation3d(share(t) * std::sin(kSwinging * (t - 0.5)) * way) * start;
  };
  return play;
}

Play rollPlay(const Stage& stage) {
  constexpr double kCurvature = 14.0, kThickest = 0.8;  // [1/m]; half thickness over radius
  const Eigen::RowVector3d half = stage.actors.at(0).rest.vertices.cwiseAbs().colwise().maxCoeff();
  const bool upwards = kCurvature * half.z() < kThickest;
  if (!upwards && kCurvature * half.y() >= kThickest)
    throw std::invalid_argument(
        "the body is too thick for this scene; its length must be at least 1.8 times "
        "its smaller thickness");
  // Sideways: the body lies on its side while it bends.
  const Eigen::AngleAxisd turn(upwards ? 0.0 : 0.5 * kPi, Eigen::Vector3d::UnitX());
  Play play;
  play.name = "roll";
  play.deformation = [=](const Eigen::Vector3d& rest, double t) -> Eigen::Vector3d {
    return turn.inverse() * bend(turn * rest, kCurvature * plateau(t, {0.5, 1.5, 1.0}));
  };
  return play;
}

Play farPlay(const Stage&) {
  constexpr double kBending = 5.0, kResting = 3.0;  // [s]
  Play play;
  play.name = "far";
  play.duration_s = kBending + kResting;
  play.deformation = [](const Eigen::Vector3d& rest, double t) {
    return bend(rest, t < kBending ? kLargestCurvature * swing(t) : 0.0);
  };
  return play;
}

Play dimPlay(const Stage& stage) {
  constexpr double kBrightness = 0.35, kFlicker = 0.25, kFrequency = 7.0 * 2.0 * kPi;  // [rad/s]
  Play play = bendPlay(stage);
  play.name = "dim";
  play.color_noise = 3.0;
  play.brightness = [](double t) { return kBrightness * (1.0 + kFlicker * std::sin(kFrequency * t)); };
  return play;
}

Play twistPlay(const Stage&) {
  Play play;
  play.name = "twist";
  play.deformation = [](const Eigen::Vector3d& rest, double t) {
    return twist(rest, kLargestTwist * swing(t));
  };
  return play;
}

Play pushPlay(const Stage& stage) { return stretching("push", stage, -kLargestStrain); }

Play pullPlay(const Stage& stage) { return stretching("pull", stage, kLargestStrain); }

BodyDeformation shorteningOnTable(const Stage& stage, const Plateau& when, double poisson_ratio) {
  constexpr double kStrain = -0.2;
  const Points& rest = stage.actors.at(0).rest.vertices;
  const double half_length = rest.col(0).cwiseAbs().maxCoeff(), bottom = rest.col(2).minCoeff();
  return [=](const Eigen::Vector3d& place, double t) -> Eigen::Vector3d {
    const double strain = kStrain * plateau(t, when);
    const Eigen::Vector3d above(place.x(), place.y(), place.z() - bottom);
    // Both ends come nearer to the middle, which stays in the shadow.
    return stretch(above, {strain, half_length, poisson_ratio}) +
           Eigen::Vector3d(-0.5 * strain * half_length, 0.0, bottom);
  };
}

Play tablePlay(const Stage& stage) {
  Play play;
  play.name = "table";
  play.deformation = shorteningOnTable(stage, {0.5, 1.5, 1.0}, 0.2);
  return play;
}

Play shakePlay(const Stage& stage) {
  constexpr double kSpeed = 1.0, kTurnRate = kPi;                                   // [m/s], [rad/s]
  constexpr double kFrequency = 2.0 * 2.0 * kPi, kTurnFrequency = 1.2 * 2.0 * kPi;  // [rad/s]
  const Eigen::Vector3d axis = Eigen::Vector3d(0.35, 0.15, 0.9).normalized();
  Play play;
  play.name = "shake";
  play.T_camera_body = [=, start = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    const double share = plateau(t, {0.5, 1.0, 2.0});
    const double offset = share * kSpeed / kFrequency * std::sin(kFrequency * (t - 0.5));
    const double angle = share * kTurnRate / kTurnFrequency * std::sin(kTurnFrequency * (t - 0.5));
    return Eigen::Translation3d(offset, 0.0, 0.0) * start * Eigen::AngleAxisd(angle, axis);
  };
  return play;
}

Play rigidPlay(const Stage& stage) {
  constexpr double kAngle = kPi / 6.0;
  const Eigen::Vector3d way = 0.05 * Eigen::Vector3d(0.7, -0.3, 0.65).normalized();  // [m]
  const Eigen::Vector3d axis = Eigen::Vector3d(0.35, -0.25, 0.9).normalized();
  Play play;
  play.name = "rigid";
  play.T_camera_body = [=, start = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    const double share = plateau(t, {0.5, 1.5, 1.0});
    return Eigen::Translation3d(share * way) * start * Eigen::AngleAxisd(share * kAngle, axis);
  };
  return play;
}

Play leavePlay(const Stage& stage) {
  constexpr double kDistance = 0.5;  // [m]
  Play play;
  play.name = "leave";
  play.T_camera_body = [start = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    return Eigen::Translation3d(-kDistance * plateau(t, {0.5, 1.5, 1.0}), 0.0, 0.0) * start;
  };
  return play;
}

}  // namespace softbody::virtual_camera
