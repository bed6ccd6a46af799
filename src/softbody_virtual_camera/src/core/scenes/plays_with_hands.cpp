#include "scenes/plays_with_hands.h"

#include <Eigen/Dense>

#include "softbody_virtual_camera/bodies/shapes.h"
#include "softbody_virtual_camera/motion/deformations.h"
#include "softbody_virtual_camera/motion/motion_profiles.h"

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
  play.props = {{{finger, skinTexture(), 1.0e-3}, pose}};
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
  play.props = {{{hand(), skinTexture(), 2.0e-3}, pose}};
  return play;
}

}  // namespace softbody::virtual_camera
