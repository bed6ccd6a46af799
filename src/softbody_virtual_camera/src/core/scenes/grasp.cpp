#include "scenes/grasp.h"

#include <Eigen/Dense>

#include "motion/deformations.h"
#include "motion/motion_profiles.h"
#include "scenes/gripper.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr Plateau kPresent{0.4, 0.7, 2.9}, kClosing{1.1, 0.3, 2.3}, kLifting{1.6, 0.8, 0.4};

Texture paint() {
  return [](const Eigen::Vector3d&) { return Eigen::Vector3f(0.20f, 0.21f, 0.23f); };
}

}  // namespace

Play graspPlay(const Stage& stage) {
  constexpr double kLift = 0.05, kFarAway = 0.45, kSag = -3.0;  // [m], [1/m]
  const Gripper gripper = makeGripper(stage.actors.at(0).rest, Eigen::Vector3d::UnitX());
  const Eigen::Vector3d hinge = gripper.inner_end;
  const auto lift = [=](double t) { return kLift * plateau(t, kLifting); };
  const auto pose = [=](double t) {
    const double closing = plateau(t, kClosing);
    GripperState state = posed(gripper, 1.0 - closing);
    state.closed = closing == 1.0;
    const double away = kFarAway * (1.0 - plateau(t, kPresent));
    return transformed(
        stage.T_camera_body * Eigen::Translation3d(away, 0.0, lift(t)) * Eigen::Isometry3d::Identity(),
        state);
  };
  Play play;
  play.name = "grasp";
  play.deformation = [=](const Eigen::Vector3d& rest, double t) -> Eigen::Vector3d {
    if (rest.x() >= hinge.x()) return rest;
    return hinge + bend(rest - hinge, kSag * plateau(t, kLifting));
  };
  play.T_camera_body = [=](double t) -> Eigen::Isometry3d {
    return stage.T_camera_body * Eigen::Translation3d(0.0, 0.0, lift(t));
  };
  play.gripper = pose;
  play.props = {rigidProp({gripper.hand, paint(), 4e-3}, [=](double t) { return pose(t).T_camera_gripper; })};
  for (const std::size_t side : {0u, 1u}) {
    play.props.push_back(rigidProp({gripper.finger, paint(), 4e-3},
                                   [=](double t) { return pose(t).T_camera_fingers.at(side); }));
  }
  return play;
}

}  // namespace softbody::virtual_camera
