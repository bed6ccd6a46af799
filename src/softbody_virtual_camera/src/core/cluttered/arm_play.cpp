#include "cluttered/arm_play.h"

#include <Eigen/Dense>

#include "cluttered/draws.h"
#include "motion/deformations.h"
#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kThickness = 0.042, kHalfTurn = 3.14159265358979323846;  // of the arm [m], [rad]

/// A cylinder from the link's origin along its x axis.
RobotLink tube(const std::string& name, const Eigen::Vector3d& joint, double length) {
  RobotLink link;
  link.name = name;
  link.T_parent_joint.translation() = joint;
  link.T_link_shape = Eigen::Translation3d(0.5 * length, 0.0, 0.0) *
                      Eigen::AngleAxisd(0.5 * kHalfTurn, Eigen::Vector3d::UnitY());
  link.radius_m = 0.5 * kThickness;
  link.length_m = length;
  return link;
}

/// Three joints that turn about vertical axes, so all links stay at one height.
Robot makeArm() {
  constexpr double kUpper = 0.20, kFore = 0.24;  // [m]
  RobotLink base, hand;
  base.name = "arm_base";
  base.box = {0.08, 0.08, 0.06};
  hand.name = "arm_hand";
  hand.box = {0.07, 0.07, 0.04};
  hand.T_parent_joint.translation().x() = kFore;
  hand.T_link_shape.translation().x() = 0.5 * hand.box.x();
  return {base, tube("arm_upper", Eigen::Vector3d::Zero(), kUpper),
          tube("arm_fore", {kUpper, 0.0, 0.0}, kFore), hand};
}

/// The poses of all links for the angles of the joints.
std::vector<Eigen::Isometry3d> poses(const Robot& robot, const Eigen::Isometry3d& T_camera_base,
                                     const Eigen::Vector3d& angles) {
  std::vector<Eigen::Isometry3d> T_camera_links = {T_camera_base};
  for (std::size_t i = 1; i < robot.size(); ++i)
    T_camera_links.push_back(
        T_camera_links.back() * robot[i].T_parent_joint *
        Eigen::AngleAxisd(angles[static_cast<Eigen::Index>(i) - 1], Eigen::Vector3d::UnitZ()));
  return T_camera_links;
}

/// Beside the body, at a height above it, on the line between it and the camera.
Eigen::Vector3d basePlace(const Stage& stage, double side, double clearance) {
  constexpr double kAside = 0.33, kMargin = 0.02;  // [m]
  const Eigen::Isometry3d T_world_camera = stage.T_camera_world.inverse();
  const Points body = transformed(T_world_camera * stage.T_camera_body, stage.actors.at(0).rest.vertices);
  const Eigen::Vector3d eye = T_world_camera.translation(), middle = body.colwise().mean();
  const double height = body.col(2).maxCoeff() + 0.5 * kThickness + kMargin + clearance;
  const double share = (height - middle.z()) / (eye.z() - middle.z());
  return {side * kAside, middle.y() + share * (eye.y() - middle.y()), height};
}

}  // namespace

Play armPlay(const Stage& stage) {
  constexpr double kCurvature = 4.0;  // [1/m]
  constexpr Plateau kAcross{0.6, 1.1, 0.6};
  Draws draws(hash(stage.seed, 46));
  const double side = draws.sign();
  const Eigen::Isometry3d T_camera_base =
      stage.T_camera_world * Eigen::Translation3d(basePlace(stage, side, draws.between(0.0, 0.02))) *
      Eigen::AngleAxisd(side > 0.0 ? kHalfTurn : 0.0, Eigen::Vector3d::UnitZ());
  // Away from the body, and then across it.
  const Eigen::Vector3d away(-side * draws.between(1.7, 2.0), -side * draws.between(0.0, 0.4), 0.0);
  const double elbow = draws.between(-0.2, 0.2);
  const Eigen::Vector3d across(-0.5 * elbow, elbow, draws.between(-0.5, 0.5));
  const Robot robot = makeArm();
  const auto posesAt = [=](double t) {
    return poses(robot, T_camera_base, away + plateau(t, kAcross) * (across - away));
  };
  Play play;
  play.name = "arm";
  play.duration_s = 4.0;
  play.repeats = false;
  play.deformation = [](const Eigen::Vector3d& rest, double t) {
    return bend(rest, kCurvature * plateau(t, {0.8, 1.2, 0.0}));
  };
  play.robot = robot;
  play.links = posesAt;
  const Eigen::Vector3f paints[] = {{0.25f, 0.26f, 0.28f}, {0.80f, 0.40f, 0.10f}};
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const Texture paint = [color = paints[i % 2]](const Eigen::Vector3d&) { return color; };
    play.props.push_back(
        rigidProp({linkMesh(robot[i]), paint, 4e-3}, [=](double t) { return posesAt(t).at(i); }));
  }
  return play;
}

}  // namespace softbody::virtual_camera
