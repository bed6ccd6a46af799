#include "elastic/held_plays.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "elastic/embedded_body.h"
#include "elastic/holders.h"
#include "elastic/steps.h"
#include "motion/motion_profiles.h"
#include "solid/held_solid.h"
#include "solid/key_states.h"

namespace softbody::virtual_camera {
namespace {

/// Where the gripper takes its end, from the pose at rest and in the body's frame, by the share of its path.
using GripperPath = std::function<Eigen::Isometry3d(double share)>;

/// A body between a clamp and a gripper.
struct HeldBody {
  EmbeddedBody body;
  Clamp clamp;
  Gripper gripper;
  Holder by_clamp, by_gripper;

  double inner() const { return clamp.T_body_clamp.translation().x(); }
  double outer() const { return gripper.inner_end.x(); }

  /// Points that follow the gripper more, the nearer they are to it: exact where one of both holds them.
  Points blended(const Eigen::Isometry3d& moved) const {
    const Points& rest = body.restNodes();
    Points all(rest.rows(), 3);
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
      const Eigen::Vector3d place = rest.row(i);
      const double share = std::clamp((place.x() - inner()) / (outer() - inner()), 0.0, 1.0);
      all.row(i) = ((1.0 - share) * place + share * (moved * place)).transpose();
    }
    return all;
  }
};

std::shared_ptr<const HeldBody> heldBody(const Stage& stage) {
  const TriangleMesh& rest = stage.actors.at(0).rest;
  const Clamp clamp = makeClamp(rest.vertices, tableHeight(stage));
  const Gripper gripper = wideGripper(rest);
  EmbeddedBody body(rest, stage.elasticity, kBendingCell_m);
  const Holder by_clamp = holderOf(clamp, body.restNodes()), by_gripper = holderOf(gripper, body.restNodes());
  HeldBody held{std::move(body), clamp, gripper, by_clamp, by_gripper};
  return std::make_shared<const HeldBody>(std::move(held));
}

/// Rows after the nodes: force and torque on the clamp, then on the gripper.
constexpr Eigen::Index kHeldRows = 4;

/// How far the nodes are from the blended ones, and the rows above, by the share of the path.
KeyStates heldStates(const HeldBody& held, const GripperPath& path, int intervals) {
  const std::vector<bool> fixed = heldByAny({held.by_clamp, held.by_gripper});
  const Eigen::Index count = held.body.restNodes().rows();
  std::vector<Points> keys;
  for (int key = 0; key <= intervals; ++key) {
    const Eigen::Isometry3d moved = path(static_cast<double>(key) / intervals);
    const Points blended = held.blended(moved);
    Points start = blended;
    if (key > 0) start += keys.back().topRows(count);
    if (key > 1) start += keys.end()[-1].topRows(count) - keys.end()[-2].topRows(count);
    const Eigen::VectorXd shape =
        heldShape(held.body.solid(), Eigen::Map<const Eigen::VectorXd>(start.data(), start.size()), fixed);
    const Points nodes = asPoints(shape), forces = asPoints(holdingForces(held.body.solid(), shape));
    Holder by_gripper = held.by_gripper;
    by_gripper.T_body_frame = moved * by_gripper.T_body_frame;
    const ContactWrench on_clamp = wrenchOn(held.by_clamp, nodes, forces),
                        on_gripper = wrenchOn(by_gripper, nodes, forces);
    Points rows(count + kHeldRows, 3);
    rows << nodes - blended, on_clamp.force.transpose(), on_clamp.torque.transpose(),
        on_gripper.force.transpose(), on_gripper.torque.transpose();
    keys.push_back(rows);
  }
  return {0.0, 1.0, keys};
}

/// @param share of the path at a time.
Play heldPlay(const Stage& stage, const GripperPath& path, int intervals,
              const std::function<double(double t)>& share) {
  const auto held = heldBody(stage);
  const auto states = std::make_shared<const KeyStates>(heldStates(*held, path, intervals));
  const Eigen::Index count = held->body.restNodes().rows();
  Play play;
  play.duration_s = kStepsDuration_s;
  play.repeats = false;
  play.material = held->body.material();
  play.shape = [=](double t) -> Points {
    const Points moved = held->blended(path(share(t))) - held->body.restNodes();
    return held->body.surface(moved + states->at(share(t)).topRows(count));
  };
  play.wrenches = [=](double t) -> std::vector<ContactWrench> {
    const Points rows = states->at(share(t)).bottomRows(kHeldRows);
    return {{"clamp", rows.row(0), rows.row(1)}, {"gripper", rows.row(2), rows.row(3)}};
  };
  addClamp(stage, held->clamp, &play);
  addGripper(
      stage, held->gripper, [=](double t) { return path(share(t)); }, &play);
  return play;
}

/// Where clamp and gripper begin.
struct FreePart {
  double inner, length;  // [m]

  explicit FreePart(const Stage& stage) {
    const TriangleMesh& rest = stage.actors.at(0).rest;
    inner = rest.vertices.col(0).minCoeff() + kClampLength_m;
    length = wideGripper(rest).inner_end.x() - inner;
  }

  /// The free part becomes an arc upwards. @param stretch of its length.
  Eigen::Isometry3d bent(double angle, double stretch) const {
    const double arc = length * (1.0 + stretch);
    const double along = angle < 1e-6 ? arc : arc * std::sin(angle) / angle;
    const double rise = angle < 1e-6 ? 0.0 : arc * (1.0 - std::cos(angle)) / angle;
    return Eigen::Translation3d(inner + along, 0.0, rise) *
           Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()) *
           Eigen::Translation3d(-inner - length, 0.0, 0.0);
  }
};

/// The angle at which the free part is bent to a radius of twice the body's thickness, at most [rad].
double largestAngle(const Stage& stage) {
  constexpr double kMost = 0.8;
  const Points& rest = stage.actors.at(0).rest.vertices;
  return std::min(kMost, FreePart(stage).length / (2.0 * (rest.col(2).maxCoeff() - rest.col(2).minCoeff())));
}

}  // namespace

Play pullHeldPlay(const Stage& stage) {
  constexpr double kStretch = 0.2, kAngle = 0.6;  // at most; share of the largest one
  const FreePart free(stage);
  const double largest = kAngle * largestAngle(stage);
  // The first half of the path pulls, the second one bends.
  const auto path = [=](double share) {
    return free.bent(largest * std::clamp(2.0 * share - 1.0, 0.0, 1.0),
                     kStretch * std::clamp(2.0 * share, 0.0, 1.0));
  };
  Play play = heldPlay(stage, path, 12, [](double t) {
    return 0.5 * (plateau(t, {0.8, 1.0, 2.7}) + plateau(t, {2.1, 0.9, 0.3}));
  });
  play.name = "pull_held";
  return play;
}

Play bendHeldPlay(const Stage& stage) {
  const FreePart free(stage);
  const double largest = largestAngle(stage);
  Play play = heldPlay(
      stage, [=](double share) { return free.bent(largest * share, 0.0); }, 10, inTwoSteps);
  play.name = "bend_held";
  return play;
}

Play twistHeldPlay(const Stage& stage) {
  constexpr double kTwist = 1.2;  // [rad]
  Play play = heldPlay(
      stage,
      [](double share) -> Eigen::Isometry3d {
        return Eigen::Isometry3d(Eigen::AngleAxisd(kTwist * share, Eigen::Vector3d::UnitX()));
      },
      10, inTwoSteps);
  play.name = "twist_held";
  return play;
}

}  // namespace softbody::virtual_camera
