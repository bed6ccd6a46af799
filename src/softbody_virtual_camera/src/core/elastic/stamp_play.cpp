#include "elastic/stamp_play.h"

#include <Eigen/Dense>

#include "elastic/pressing.h"
#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {

TriangleMesh stampMesh(double radius) {
  constexpr double kThickness = 0.02, kRod = 0.008, kRodLength = 0.35;  // [m]
  TriangleMesh disc = cylinder(radius, kThickness);
  disc.vertices.col(2).array() += 0.5 * kThickness;
  return merge({disc, capsule({0.0, 0.0, kThickness}, {0.0, 0.0, kRodLength}, kRod)});
}

Texture stampPaint() {
  return [](const Eigen::Vector3d&) { return Eigen::Vector3f(0.16f, 0.22f, 0.30f); };
}

std::function<double(double)> forceOfStamp(const Stage& stage, double radius_m) {
  constexpr double kPi = 3.14159265358979323846, kShortened = 0.008;  // [m]
  const double pressure = stage.elasticity.youngs_modulus_pa * kShortened;
  return [=](double height_m) { return pressure * kPi * radius_m * radius_m / height_m; };
}

Play stampPlay(const Stage& stage) {
  constexpr double kRadius = 0.03, kFarAway = 0.45;  // [m]
  const auto body = std::make_shared<const PressedBody>(pressedBody(stage));
  PressingThing stamp{"stamp", stampMesh(kRadius), stampPaint(), {Eigen::Vector2d(0.02, 0.0), kRadius}};
  stamp.largest_n = forceOfStamp(stage, kRadius);
  stamp.root = [](double t) { return plateau(t, {1.4, 0.9, 0.5}); };
  stamp.away_m = [](double t) { return kFarAway * (1.0 - plateau(t, {0.5, 0.8, 2.5})); };
  const Pressing pressed = pressing(stage, body, stamp);
  Play play = pressed.play;
  play.name = "stamp";
  play.forces = [states = pressed.states, root = stamp.root](double t) -> std::vector<SurfaceForce> {
    if (root(t) == 0.0) return {};
    const ContactForce by_stamp = states->stamp(root(t)), by_table = states->table(root(t));
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    return {{"stamp", by_stamp.place, up, by_stamp.force}, {"table", by_table.place, -up, by_table.force}};
  };
  return play;
}

}  // namespace softbody::virtual_camera
