#include "elastic/pressing_plays.h"

#include <Eigen/Dense>

#include "elastic/pressing.h"
#include "elastic/stamp_play.h"
#include "elastic/steps.h"
#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kPlateThick_m = 0.012;

/// A plate in the frame of its flat side, whose z axis points away from the body, with a rod.
/// @param size along x, y of that frame. @param rod from the middle of the plate on.
TriangleMesh plateMesh(const Eigen::Vector2d& size, const Eigen::Vector3d& rod) {
  constexpr double kRod = 0.005;  // [m]
  TriangleMesh plate = box({size.x(), size.y(), kPlateThick_m});
  plate.vertices.col(2).array() += 0.5 * kPlateThick_m;
  const Eigen::Vector3d middle(0.0, 0.0, 0.5 * kPlateThick_m);
  return merge({plate, capsule(middle, middle + rod, kRod)});
}

/// A flat side that is larger than all bodies.
PressedSolid::Stamp wholeSide() { return {Eigen::Vector2d::Zero(), 1.0}; }

Eigen::Vector3d sizeOf(const Stage& stage) {
  const Points& rest = stage.actors.at(0).rest.vertices;
  return (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).transpose();
}

/// The force at which the body would be shorter by a share of its extent, if it were a column.
std::function<double(double)> forceThatShortens(const Stage& stage, const PressedBody& pressed,
                                                double share) {
  const double force = stage.elasticity.youngs_modulus_pa * share * pressed.body.material().volume_m3;
  return [=](double height_m) { return force / height_m; };
}

}  // namespace

Play platesPlay(const Stage& stage) {
  constexpr double kBeyond = 0.02, kShortened = 0.13;  // [m], of the body's width
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), size = sizeOf(stage);
  const auto body = std::make_shared<const PressedBody>(pressedBody(stage, x, y));
  const Eigen::Vector2d side(size.x() + 2.0 * kBeyond, size.z());
  const double to_table = -tableHeight(stage);
  // y of the plate's frame points down, and up in the frame of the other one.
  PressingThing plate{"plate", plateMesh(side, {0.0, to_table, 0.0}), darkPaint(), wholeSide()};
  plate.largest_n = forceThatShortens(stage, *body, kShortened);
  plate.root = [](double t) { return plateau(t, {0.8, 1.6, 1.0}); };
  Play play = pressing(stage, body, plate).play;
  play.name = "plates";
  const Eigen::Isometry3d T_camera_fixed = stage.T_camera_body * body->T_body_solver *
                                           Eigen::Translation3d(0.0, 0.0, body->low()) *
                                           Eigen::AngleAxisd(3.14159265358979323846, x);
  addFrame(
      "table_plate", [=](double) { return T_camera_fixed; }, &play);
  play.props.push_back(rigidProp({plateMesh(side, {0.0, -to_table, 0.0}), darkPaint(), 2.0e-3},
                                 [=](double) { return T_camera_fixed; }));
  return play;
}

Play pushHeldPlay(const Stage& stage) {
  constexpr double kBeyond = 0.01, kArm = 0.3, kShortened = 0.15;  // [m], of the body's length
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), size = sizeOf(stage);
  const auto body = std::make_shared<const PressedBody>(pressedBody(stage, y, x));
  const Eigen::Vector2d side(size.y() + 2.0 * kBeyond, size.z() + 2.0 * kBeyond);
  PressingThing plate{"plate", plateMesh(side, {0.0, 0.0, kArm}), darkPaint(), wholeSide()};
  plate.largest_n = forceThatShortens(stage, *body, kShortened);
  plate.root = inTwoSteps;
  const Clamp clamp = makeClamp(stage.actors.at(0).rest.vertices, tableHeight(stage));
  const Points nodes = transformed(body->T_body_solver, body->body.restNodes());
  Play play = pressing(stage, body, plate, {holderOf(clamp, nodes)}).play;
  play.name = "push_held";
  play.duration_s = kStepsDuration_s;
  play.repeats = false;
  addClamp(stage, clamp, &play);
  return play;
}

Play pressHeldPlay(const Stage& stage) {
  constexpr double kRadius = 0.025, kFarAway = 0.3;  // [m]
  const TriangleMesh& rest = stage.actors.at(0).rest;
  const auto body = std::make_shared<const PressedBody>(pressedBody(stage));
  const Clamp clamp = makeClamp(rest.vertices, tableHeight(stage));
  const Gripper gripper = wideGripper(rest);
  const double middle = 0.5 * (clamp.T_body_clamp.translation().x() + gripper.inner_end.x());
  PressingThing stamp{"stamp", stampMesh(kRadius), stampPaint(), {Eigen::Vector2d(middle, 0.0), kRadius}};
  stamp.largest_n = forceOfStamp(stage, kRadius);
  stamp.root = inTwoSteps;
  stamp.away_m = [](double t) { return kFarAway * (1.0 - smoothStep(t / 0.8 - 0.5)); };
  const Points& nodes = body->body.restNodes();
  Play play = pressing(stage, body, stamp, {holderOf(clamp, nodes), holderOf(gripper, nodes)}).play;
  play.name = "press_held";
  play.duration_s = kStepsDuration_s;
  play.repeats = false;
  addClamp(stage, clamp, &play);
  addGripper(
      stage, gripper, [](double) { return Eigen::Isometry3d::Identity(); }, &play);
  return play;
}

}  // namespace softbody::virtual_camera
