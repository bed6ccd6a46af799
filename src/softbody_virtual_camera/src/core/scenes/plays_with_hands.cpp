#include "scenes/plays_with_hands.h"

#include <Eigen/Dense>
#include <cmath>

#include "hands/hand.h"
#include "motion/deformations.h"
#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

/// The highest vertex near a vertical line through the body.
Eigen::Vector3d topOf(const Points& rest, double x, double y) {
  constexpr double kNear = 0.015;  // [m]
  Eigen::Vector3d top(x, y, rest.col(2).minCoeff());
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    const bool near = (rest.row(i).head<2>() - Eigen::RowVector2d(x, y)).norm() < kNear;
    if (near && rest(i, 2) > top.z() + 1e-9) top = rest.row(i);
  }
  return top;
}

/// When a hand is there, and when it holds the body.
constexpr Plateau kThere{0.5, 0.8, 2.4}, kHolding{1.2, 0.3, 2.0};

/// A hand in the body's own colour, which holds the body while it deforms.
/// @param deformation at one time. @param strain of the body along its length at one time.
Prop holdingHand(const Stage& stage, const Grip& grip,
                 const std::function<Deformation(double t)>& deformation,
                 const std::function<double(double t)>& strain) {
  constexpr double kFarAway = 0.45;  // [m]
  const Hand hand = makeHand(stage.actors.at(0).rest, grip);
  const auto vertices = [=, T_camera_body = stage.T_camera_body](double t) {
    const HandPose pose{deformation(t), strain(t), 1.0 - plateau(t, kHolding),
                        kFarAway * (1.0 - plateau(t, kThere))};
    return transformed(T_camera_body, posed(hand, pose));
  };
  return {{hand.mesh, [](const Eigen::Vector3d&) { return plainColor(); }, 1.0}, vertices};
}

}  // namespace

Play pressPlay(const Stage& stage) {
  constexpr double kDepth = 0.015, kRadius = 0.009, kRetreat = 0.20;  // [m]
  const Points& rest = stage.actors.at(0).rest.vertices;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), along = Eigen::Vector3d(0.35, 0.55, 0.75).normalized();
  Dent deepest;
  deepest.contact = topOf(rest, 0.02, 0.0);
  deepest.floor_m = rest.col(2).minCoeff();
  const auto depth = [](double t) { return kDepth * plateau(t, {1.25, 0.75, 1.0}); };
  Play play;
  play.name = "press";
  play.deformation = [=](const Eigen::Vector3d& place, double t) {
    Dent now = deepest;
    now.depth_m = depth(t);
    return dent(place, now);
  };
  // The finger's lowest point touches the deepest point of the dent.
  const auto pose = [=, start = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    const double away = kRetreat * (1.0 - plateau(t, {0.5, 0.75, 2.5}));
    return start * Eigen::Translation3d(deepest.contact + (kRadius - depth(t)) * up + away * along);
  };
  const TriangleMesh finger = capsule(Eigen::Vector3d::Zero(), 0.15 * along, kRadius);
  play.props = {rigidProp({finger, skinTexture(), 1.0e-3}, pose)};
  return play;
}

Play occludePlay(const Stage&) {
  constexpr double kCurvature = 4.0;                                          // [1/m]
  const Eigen::Vector3d covering(-0.006, 0.0, 0.38), travel(0.30, 0.0, 0.0);  // of the finger tips [m]
  Play play;
  play.name = "occlude";
  play.deformation = [](const Eigen::Vector3d& rest, double t) {
    return bend(rest, kCurvature * plateau(t, {0.75, 1.75, 0.0}));
  };
  const auto pose = [=](double t) -> Eigen::Isometry3d {
    return Eigen::Translation3d(covering + (1.0 - plateau(t, {0.5, 0.75, 2.0})) * travel) *
           Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitY());
  };
  play.props = {rigidProp({hand(), skinTexture(), 2.0e-3}, pose)};
  return play;
}

Play touchPlay(const Stage& stage) {
  constexpr double kCurvature = 5.0;  // [1/m]
  const Points& rest = stage.actors.at(0).rest.vertices;
  const Eigen::Vector3d outward = Eigen::Vector3d::UnitX(), fixed = rest.col(0).minCoeff() * outward;
  const auto deformation = [=](double t) -> Deformation {
    const double curvature = kCurvature * plateau(t, {1.5, 0.9, 0.2});
    return [=](const Eigen::Vector3d& place) -> Eigen::Vector3d {
      return fixed + bend(place - fixed, curvature);
    };
  };
  Play play;
  play.name = "touch";
  play.deformation = [=](const Eigen::Vector3d& place, double t) { return deformation(t)(place); };
  play.props = {holdingHand(stage, holdingGrip(rest, outward), deformation, [](double) { return 0.0; })};
  return play;
}

Play squeezePlay(const Stage& stage) {
  constexpr double kStrain = -0.3, kPoissonRatio = 0.2;
  const auto strain = [](double t) { return kStrain * plateau(t, {1.5, 0.8, 0.4}); };
  const auto deformation = [=](double t) -> Deformation {
    const double along = 1.0 + strain(t), across = std::pow(along, -kPoissonRatio);
    return [=](const Eigen::Vector3d& place) -> Eigen::Vector3d {
      return place.cwiseProduct(Eigen::Vector3d(along, across, across));
    };
  };
  Play play;
  play.name = "squeeze";
  play.deformation = [=](const Eigen::Vector3d& place, double t) { return deformation(t)(place); };
  for (const double end : {1.0, -1.0}) {
    const Grip grip = pushingGrip(stage.actors.at(0).rest.vertices, end * Eigen::Vector3d::UnitX());
    play.props.push_back(holdingHand(stage, grip, deformation, strain));
  }
  return play;
}

}  // namespace softbody::virtual_camera
