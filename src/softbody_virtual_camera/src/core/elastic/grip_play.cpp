#include "elastic/grip_play.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "elastic/embedded_body.h"
#include "hands/fist.h"
#include "motion/motion_profiles.h"
#include "solid/held_solid.h"
#include "solid/key_states.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kFistAway_m = 0.45;

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

}  // namespace

Play gripPlay(const Stage& stage) {
  const auto body = std::make_shared<const EmbeddedBody>(stage.actors.at(0).rest, stage.elasticity);
  const FistMotion motion(stage.actors.at(0).rest.vertices);
  const auto between = std::make_shared<const KeyStates>(heldBetween(body->solid(), motion));
  Play play;
  play.name = "grip";
  play.duration_s = 6.5;
  play.material = body->material();
  play.shape = [=](double t) -> Points {
    return body->surface(motion.blended(body->restNodes(), t) - body->restNodes() + between->at(t));
  };
  for (const double outward : {-1.0, 1.0}) {
    const auto pose = [=, T_camera_body = stage.T_camera_body](double t) -> Eigen::Isometry3d {
      const double away = kFistAway_m * (1.0 - plateau(t, {0.5, 0.7, 4.3}));
      return T_camera_body * motion.fist(t, outward) * Eigen::Translation3d(outward * away, 0.0, 0.0);
    };
    play.props.push_back(
        rigidProp({makeFist(stage.actors.at(0).rest.vertices, outward), skinTexture(), 2.0e-3}, pose));
  }
  return play;
}

}  // namespace softbody::virtual_camera
