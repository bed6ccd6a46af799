#include "cluttered/held_play.h"

#include <Eigen/Dense>

#include "cluttered/draws.h"
#include "hands/fist.h"
#include "motion/deformations.h"
#include "motion/motion_profiles.h"

namespace softbody::virtual_camera {

Play heldPlay(const Stage& stage) {
  constexpr double kShift = 4e-3, kTilt = 0.03;                   // of the pose at the start [m], [rad]
  constexpr double kLift = 0.03, kTurn = 0.35, kCurvature = 3.0;  // [m], [rad], [1/m]
  constexpr Plateau kMoving{1.0, 0.8, 0.4};
  Draws draws(hash(stage.seed, 44));
  const Points& rest = stage.actors.at(0).rest.vertices;
  const double outward = draws.sign();
  const auto drawn = [&](double most) -> Eigen::Vector3d {
    return {draws.between(-most, most), draws.between(-most, most), draws.between(-most, most)};
  };
  const Eigen::Vector3d shift = drawn(kShift), tilt = drawn(kTilt), turn = drawn(1.0).normalized();
  const float tone = static_cast<float>(draws.between(0.4, 1.0));
  const Eigen::Isometry3d T_camera_start =
      stage.T_camera_body * Eigen::Translation3d(shift) * Eigen::AngleAxisd(tilt.norm(), tilt.normalized());
  const Eigen::Vector3d hinge(outward * ((outward * rest.col(0)).maxCoeff() - kFistLength), 0.0, 0.0);
  const auto T_camera_body = [=](double t) -> Eigen::Isometry3d {
    const double share = plateau(t, kMoving);
    return T_camera_start * Eigen::Translation3d(0.0, 0.0, share * kLift) *
           Eigen::AngleAxisd(share * kTurn, turn);
  };
  Play play;
  play.name = "held";
  play.duration_s = 3.0;
  play.repeats = false;
  play.T_camera_body = T_camera_body;
  play.deformation = [=](const Eigen::Vector3d& place, double t) -> Eigen::Vector3d {
    if (outward * (place.x() - hinge.x()) >= 0.0) return place;
    return hinge + bend(place - hinge, -kCurvature * plateau(t, kMoving));
  };
  const Texture skin = [=, light = skinTexture()](const Eigen::Vector3d& place) -> Eigen::Vector3f {
    return tone * light(place);
  };
  play.props = {rigidProp({makeFist(rest, outward), skin, 2.0e-3}, T_camera_body)};
  return play;
}

}  // namespace softbody::virtual_camera
