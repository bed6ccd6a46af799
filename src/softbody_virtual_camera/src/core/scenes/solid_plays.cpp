#include "scenes/solid_plays.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "hands/fist.h"
#include "softbody_virtual_camera/bodies/shapes.h"
#include "softbody_virtual_camera/motion/motion_profiles.h"
#include "solid/held_solid.h"
#include "solid/key_states.h"
#include "solid/pressed_solid.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kCircle = 2.0 * 3.14159265358979323846;  // [rad]
constexpr double kCell_m = 0.01;
constexpr double kFarAway_m = 0.45;

/// The body's surface in a grid of cells.
class EmbeddedBody {
 public:
  explicit EmbeddedBody(const Stage& stage)
      : rest_(stage.actors.at(0).rest.vertices),
        solid_(fillWithCells(stage.actors.at(0).rest, kCell_m),
               StableNeoHookean(stage.elasticity.youngs_modulus_pa, stage.elasticity.poisson_ratio)) {
    for (Eigen::Index i = 0; i < rest_.rows(); ++i) places_.push_back(solid_.grid().embed(rest_.row(i)));
  }

  const HexSolid& solid() const { return solid_; }
  const Points& restNodes() const { return solid_.grid().nodes; }

  /// The vertices of the surface. @param moved how far each node has moved.
  Points surface(const Points& moved) const {
    Points vertices = rest_;
    for (Eigen::Index i = 0; i < vertices.rows(); ++i)
      vertices.row(i) += places_[static_cast<std::size_t>(i)].in(moved).transpose();
    return vertices;
  }

 private:
  Points rest_;
  HexSolid solid_;
  std::vector<Embedding> places_;
};

/// The way of both fists. It keeps the middle of the body in place, but for the lift.
class FistMotion {
 public:
  static constexpr double kBegin = 1.3, kEnd = 5.4;  // while they hold the body [s]

  explicit FistMotion(const Points& rest) {
    constexpr double kSharpest = 11.0, kStrain = 0.5;  // [1/m]; at most, at the surface
    const double half_length = rest.col(0).cwiseAbs().maxCoeff();
    inner_ = half_length - kFistLength;
    largest_bend_ = 2.0 * inner_ * std::min(kSharpest, kStrain / rest.col(2).cwiseAbs().maxCoeff());
  }

  /// @param outward 1: at positive x; -1: at negative x. @return from the rest pose, in the body's frame.
  Eigen::Isometry3d fist(double t, double outward) const {
    constexpr double kLift = 0.03, kTwist = 1.4, kStretch = 0.25;  // [m], [rad], share of the free length
    const double bend = largest_bend_ * plateau(t, {1.5, 0.7, 0.5}), half = 0.5 * bend;
    const double twist = kTwist * plateau(t, {2.5, 0.7, 0.4}),
                 stretch = kStretch * plateau(t, {3.7, 0.6, 0.3});
    const double length = inner_ * (1.0 + stretch);
    const double along = half < 1e-6 ? length : length * std::sin(half) / half;
    const double rise = half < 1e-6 ? 0.0 : length * (1.0 - std::cos(half)) / half;
    const Eigen::Vector3d place(outward * along, 0.0, kLift * plateau(t, {kBegin, 0.5, 3.1}) + rise);
    return Eigen::Translation3d(place) * Eigen::AngleAxisd(-outward * half, Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(0.5 * outward * twist, Eigen::Vector3d::UnitX()) *
           Eigen::Translation3d(-outward * inner_, 0.0, 0.0);
  }

  /// Points that move with the fists, or between them with both: exact where a fist holds the body.
  Points blended(const Points& rest, double t) const {
    const Eigen::Isometry3d left = fist(t, -1.0), right = fist(t, 1.0);
    Points moved(rest.rows(), 3);
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
      const Eigen::Vector3d place = rest.row(i);
      const double share = std::clamp(0.5 * (1.0 + place.x() / inner_), 0.0, 1.0);
      moved.row(i) = ((1.0 - share) * (left * place) + share * (right * place)).transpose();
    }
    return moved;
  }

  bool holds(const Eigen::Vector3d& rest) const { return std::abs(rest.x()) > inner_ - 1e-9; }

 private:
  double inner_ = 0.0, largest_bend_ = 0.0;  // distance of a fist from the middle [m]; [rad]
};

/// How far the nodes are from those that blend both fists.
KeyStates heldBetween(const HexSolid& solid, const FistMotion& motion) {
  constexpr int kIntervals = 24;
  const Points& rest = solid.grid().nodes;
  std::vector<bool> held;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) held.push_back(motion.holds(rest.row(i)));
  std::vector<Points> keys = {Points::Zero(rest.rows(), 3)};
  for (int key = 1; key < kIntervals; ++key) {
    const Points blended =
        motion.blended(rest, FistMotion::kBegin + (FistMotion::kEnd - FistMotion::kBegin) * key / kIntervals);
    const Points start = blended + (key > 1 ? Points(2.0 * keys.end()[-1] - keys.end()[-2]) : keys.back());
    keys.push_back(
        asPoints(heldShape(solid, Eigen::Map<const Eigen::VectorXd>(start.data(), start.size()), held)) -
        blended);
  }
  keys.emplace_back(Points::Zero(rest.rows(), 3));
  return {FistMotion::kBegin, FistMotion::kEnd, keys};
}

/// Rows after the nodes of a pressed body.
enum StampRow { kStampPlace, kStampForce, kTablePlace, kTableForce, kStampHeight, kStampRows };

/// How far the nodes have moved, and the rows above, by the square root of the share of the largest force: so
/// that the first touch of a round body has no vertical tangent.
KeyStates pressedStates(const HexSolid& solid, const TriangleMesh& body, const PressedSolid::Stamp& stamp,
                        const Elasticity& elasticity) {
  constexpr double kShortened = 0.008;  // what the largest force would do to a column under the stamp [m]
  constexpr int kIntervals = 10;
  PressedSolid pressed(solid, body, stamp, elasticity.youngs_modulus_pa);
  const Points& rest = solid.grid().nodes;
  const double height = pressed.shape().stamp_m - rest.col(2).minCoeff();
  const double largest_n =
      elasticity.youngs_modulus_pa * 0.5 * kCircle * stamp.radius_m * stamp.radius_m * kShortened / height;
  std::vector<Points> keys;
  const auto add = [&](const PressedShape& shape) {
    Points key(rest.rows() + kStampRows, 3);
    key << asPoints(shape.nodes) - rest, shape.stamp.place.transpose(), shape.stamp.force.transpose(),
        shape.table.place.transpose(), shape.table.force.transpose(), 0.0, 0.0, shape.stamp_m;
    keys.push_back(key);
  };
  add(pressed.shape());
  for (int key = 1; key <= kIntervals; ++key)
    add(pressed.press(largest_n * key * key / static_cast<double>(kIntervals * kIntervals)));
  for (const StampRow place : {kStampPlace, kTablePlace})
    keys[0].row(rest.rows() + place) = keys[1].row(rest.rows() + place);
  return {0.0, 1.0, keys};
}

/// A disc with a rod for a handle; the origin is the middle of its flat side.
TriangleMesh stampMesh(double radius) {
  constexpr double kThickness = 0.02, kRod = 0.008, kRodLength = 0.35;  // [m]
  TriangleMesh disc = cylinder(radius, kThickness);
  disc.vertices.col(2).array() += 0.5 * kThickness;
  return merge({disc, capsule({0.0, 0.0, kThickness}, {0.0, 0.0, kRodLength}, kRod)});
}

Texture paintedWood() {
  return [](const Eigen::Vector3d&) { return Eigen::Vector3f(0.16f, 0.22f, 0.30f); };
}

}  // namespace

Play gripPlay(const Stage& stage) {
  const auto body = std::make_shared<const EmbeddedBody>(stage);
  const FistMotion motion(stage.actors.at(0).rest.vertices);
  const auto between = std::make_shared<const KeyStates>(heldBetween(body->solid(), motion));
  Play play;
  play.name = "grip";
  play.duration_s = 6.5;
  play.shape = [=](double t) -> Points {
    return body->surface(motion.blended(body->restNodes(), t) - body->restNodes() + between->at(t));
  };
  for (const double outward : {-1.0, 1.0}) {
    const auto pose = [=, T_camera_body = stage.T_camera_body](double t) -> Eigen::Isometry3d {
      const double away = kFarAway_m * (1.0 - plateau(t, {0.5, 0.7, 4.3}));
      return T_camera_body * motion.fist(t, outward) * Eigen::Translation3d(outward * away, 0.0, 0.0);
    };
    play.props.push_back(
        rigidProp({makeFist(stage.actors.at(0).rest.vertices, outward), skinTexture(), 2.0e-3}, pose));
  }
  return play;
}

Play stampPlay(const Stage& stage) {
  const TriangleMesh& rest = stage.actors.at(0).rest;
  const PressedSolid::Stamp stamp{Eigen::Vector2d(0.02, 0.0), 0.03};
  const auto body = std::make_shared<const EmbeddedBody>(stage);
  const auto states =
      std::make_shared<const KeyStates>(pressedStates(body->solid(), rest, stamp, stage.elasticity));
  const Eigen::Index nodes = body->restNodes().rows();
  const auto rootShare = [](double t) { return plateau(t, {1.4, 0.9, 0.5}); };
  const auto row = [=](double t, StampRow which) -> Eigen::Vector3d {
    return states->at(rootShare(t)).row(nodes + which);
  };
  Play play;
  play.name = "stamp";
  play.shape = [=](double t) -> Points { return body->surface(states->at(rootShare(t)).topRows(nodes)); };
  play.forces = [=](double t) -> std::vector<SurfaceForce> {
    if (rootShare(t) == 0.0) return {};
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    return {{"stamp", row(t, kStampPlace), up, row(t, kStampForce)},
            {"table", row(t, kTablePlace), -up, row(t, kTableForce)}};
  };
  const auto pose = [=, T_camera_body = stage.T_camera_body](double t) -> Eigen::Isometry3d {
    const double away = kFarAway_m * (1.0 - plateau(t, {0.5, 0.8, 2.5}));
    return T_camera_body *
           Eigen::Translation3d(stamp.center.x(), stamp.center.y(), row(t, kStampHeight).z() + away);
  };
  play.props = {rigidProp({stampMesh(stamp.radius_m), paintedWood(), 2.0e-3}, pose)};
  return play;
}

}  // namespace softbody::virtual_camera
