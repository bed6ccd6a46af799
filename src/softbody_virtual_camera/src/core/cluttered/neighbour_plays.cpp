#include "cluttered/neighbour_plays.h"

#include <Eigen/Dense>
#include <algorithm>

#include "cluttered/looks.h"
#include "cluttered/reach.h"
#include "scenes/plays.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kRightAngle = 0.5 * 3.14159265358979323846;  // [rad]
constexpr double kAway_m = 0.25;                              // how far a thing is slid away
constexpr double kSliding_s = 0.8, kGone_s = 1.8;             // it begins to move 1 s after the start
constexpr double kPoissonRatio = 0.2;  // of the body, when nothing is beside it any more

Eigen::Vector3d halfSize(const Stage& stage) {
  return stage.actors.at(0).rest.vertices.cwiseAbs().colwise().maxCoeff();
}

/// A frame in the body's frame: z along a horizontal direction, y up.
Eigen::Isometry3d facing(double angle, double aside, double height) {
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0), up = Eigen::Vector3d::UnitZ();
  Eigen::Isometry3d T_body_face = Eigen::Isometry3d::Identity();
  T_body_face.linear() << up.cross(out), up, out;
  T_body_face.translation() = aside * up.cross(out) + height * up;
  return T_body_face;
}

/// A thing leaves to one side; then the body becomes shorter.
Play leavingPlay(const std::string& name, const Stage& stage, const Thing& thing, const Actor& look,
                 const Eigen::Vector3d& outward) {
  Play play;
  play.name = name;
  play.duration_s = 3.0;
  play.repeats = false;
  play.deformation = shorteningOnTable(stage, {kGone_s, 0.6, 0.0}, kPoissonRatio);
  Prop prop = movedThing(stage, thing, look.texture, [=](double t) -> Eigen::Vector3d {
    return kAway_m * smoothStep((t - kGone_s + kSliding_s) / kSliding_s) * outward;
  });
  prop.actor = look;
  play.props = {prop};
  return play;
}

}  // namespace

Play neighbourPlay(const Stage& stage) {
  constexpr double kMostTurn = 0.14, kHighest = 0.08, kTexel = 1.0e-3;  // [rad], [m], [m]
  Draws draws(hash(stage.seed, 41));
  const Eigen::Vector3d half = halfSize(stage);
  const int side = draws.below(4);
  const double angle = side * kRightAngle + draws.between(-kMostTurn, kMostTurn);
  const Eigen::Vector3d size(draws.between(0.06, 0.11),
                             std::min(kHighest, draws.between(0.6, 1.0) * 2.0 * half.z()),
                             draws.between(0.03, 0.06));
  const double aside = draws.between(-0.3, 0.3) * half[side % 2 == 0 ? 1 : 0];
  const Eigen::Isometry3d T_body_face =
      facing(angle, aside, stage.actors.at(0).rest.vertices.col(2).minCoeff() + 0.5 * size.y());
  const double reach = reachOf(stage.actors.at(0).rest, T_body_face, 0.5 * size.head<2>());
  const Thing neighbour{box(size), T_body_face * Eigen::Translation3d(0.0, 0.0, reach + 0.5 * size.z())};
  return leavingPlay("neighbour", stage, neighbour, {neighbour.mesh, drawnLook(&draws), kTexel},
                     T_body_face.linear().col(2));
}

Play twinPlay(const Stage& stage) {
  constexpr double kGap = 4e-3, kMostAside = 0.025;  // [m]
  Draws draws(hash(stage.seed, 42));
  const Points& rest = stage.actors.at(0).rest.vertices;
  const double side = draws.sign(), turn = draws.below(2) * 2.0 * kRightAngle;
  const Eigen::Vector3d outward = side * Eigen::Vector3d::UnitY();
  const double width = rest.col(1).maxCoeff() - rest.col(1).minCoeff();
  Thing twin{stage.actors.at(0).rest, Eigen::Isometry3d::Identity()};
  twin.T_body_thing =
      Eigen::Translation3d(draws.between(-kMostAside, kMostAside), side * (width + kGap), 0.0) *
      Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  return leavingPlay("twin", stage, twin, stage.actors.at(0), outward);
}

Play stackPlay(const Stage& stage) {
  constexpr double kShare = 1.0 / 3.0, kMostTurn = 0.17, kLift = 0.15;  // of the length, [rad], [m]
  Draws draws(hash(stage.seed, 43));
  const Eigen::Vector3d half = halfSize(stage);
  const Eigen::Vector3d size(draws.between(0.9, 1.1) * kShare * 2.0 * half.x(),
                             draws.between(0.85, 1.0) * 2.0 * half.y(), draws.between(0.02, 0.04));
  Eigen::Isometry3d T_body_face = Eigen::Isometry3d::Identity();
  T_body_face.translation().x() = draws.between(-1.0, 1.0) * (half.x() - 0.5 * size.x());
  T_body_face.rotate(Eigen::AngleAxisd(draws.between(-kMostTurn, kMostTurn), Eigen::Vector3d::UnitZ()));
  const double reach = reachOf(stage.actors.at(0).rest, T_body_face, 0.5 * size.head<2>());
  const Thing top{box(size), T_body_face * Eigen::Translation3d(0.0, 0.0, reach + 0.5 * size.z())};
  const Eigen::Vector3d way(draws.sign() * kAway_m, 0.0, kLift);
  Play play;
  play.name = "stack";
  play.duration_s = 4.0;
  play.repeats = false;
  play.deformation = shorteningOnTable(stage, {kGone_s, 0.6, 0.0}, kPoissonRatio);
  // Up before it goes aside, and down after that.
  play.props = {movedThing(stage, top, drawnLook(&draws), [=](double t) -> Eigen::Vector3d {
    const double up = plateau(t, {1.0, 0.6, 1.6}), aside = plateau(t, {1.3, 0.6, 0.9});
    return {aside * way.x(), 0.0, up * way.z()};
  })};
  return play;
}

}  // namespace softbody::virtual_camera
