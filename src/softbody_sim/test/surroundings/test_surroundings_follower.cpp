#include <test_support/gtest.h>

#include <map>
#include <random>
#include <stdexcept>
#include <string>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/surroundings/surroundings_follower.h"

namespace softbody {
namespace {

using testing::sponge;

constexpr Nanoseconds kFrame = 33333333;
constexpr double kLimit_m = 1e-12;

/// The sponge, pins at its end x < 1 cm, and frames whose poses the test sets.
class FollowedSurroundings : public ::testing::Test {
 protected:
  static PinRegion endIn(const std::string& frame) {
    return {"end", frame, Eigen::Vector3d::Constant(-1.0), {0.01, 1.0, 1.0}};
  }
  static PinRegion boxIn(const std::string& frame) {
    return {"gripper", frame, Eigen::Vector3d::Constant(-0.02), Eigen::Vector3d::Constant(0.02), true};
  }
  Eigen::Isometry3d randomPose() {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto any = [&] { return Eigen::Vector3d(number(random_), number(random_), number(random_)); };
    return Eigen::Translation3d(any()) * Eigen::AngleAxisd(3.0 * number(random_), any().normalized());
  }
  FrameLookup lookup() {
    return [this](const std::string& frame, Nanoseconds stamp) -> std::optional<StampedPose> {
      const auto found = poses_.find(frame);
      if (found == poses_.end()) return std::nullopt;
      return StampedPose{found->second, stamp};
    };
  }
  const Surroundings& at(Nanoseconds stamp) {
    return follower_.surroundingsAt(stamp, lookup(), rest_, stamp - kFrame);
  }
  std::vector<std::string> warnings() {
    std::vector<std::string> texts;
    for (const LogLine& line : follower_.takeLog())
      if (line.is_warning) texts.push_back(line.text);
    return texts;
  }

  const TetTopology topology_ = sponge();
  const Points rest_ = topology_.rest_vertices;
  std::map<std::string, Eigen::Isometry3d> poses_;
  SurroundingsFollower follower_{0.001};
  std::mt19937 random_{7};
};

TEST_F(FollowedSurroundings, HeldVerticesMoveRigidlyWithTheFrame) {
  poses_["hand"] = randomPose();
  const Eigen::Isometry3d before = poses_["hand"];
  follower_.addPin(endIn("hand"), topology_);
  at(kFrame);
  for (int frame = 2; frame < 10; ++frame) {
    poses_["hand"] = randomPose();
    const Surroundings& now = at(frame * kFrame);
    ASSERT_FALSE(now.pins.empty());
    for (const Pin& pin : now.pins) {
      const Eigen::Vector3d held = rest_.row(pin.vertex);
      EXPECT_LT(held.x(), 0.01);
      EXPECT_LT((pin.position - poses_["hand"] * before.inverse() * held).norm(), kLimit_m);
    }
  }
}

TEST_F(FollowedSurroundings, AnUnknownFrameIsSaidOnceAndWaitedFor) {
  follower_.addPin(endIn("hand"), topology_);
  ObstacleDescription ball{"ball", "elbow", Obstacle::sphere(0.05)};
  follower_.setObstacle(ball);
  for (int frame = 1; frame < 90; ++frame) {
    EXPECT_TRUE(at(frame * kFrame).pins.empty());
    EXPECT_TRUE(follower_.lastSurroundings().all.obstacles.empty());
  }
  const std::vector<std::string> said = warnings();
  ASSERT_EQ(said.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(says(said[k], k == 0 ? "frame 'elbow'" : "frame 'hand'"));
    EXPECT_TRUE(says(said[k], "tf does not know it"));
  }
  EXPECT_EQ(follower_.faults().size(), 2U);
  poses_["hand"] = poses_["elbow"] = randomPose();
  const Surroundings& now = at(90 * kFrame);
  ASSERT_EQ(now.obstacles.size(), 1U);
  ASSERT_FALSE(now.pins.empty());
  for (const Pin& pin : now.pins)
    EXPECT_LT((pin.position - Eigen::Vector3d(rest_.row(pin.vertex))).norm(), kLimit_m);
  EXPECT_TRUE(follower_.faults().empty());
}

TEST_F(FollowedSurroundings, WhatFollowsASilentFrameStaysAtItsLastPose) {
  poses_["hand"] = randomPose();
  follower_.addPin(endIn("hand"), topology_);
  const std::vector<Pin> before = at(kFrame).pins;
  poses_.clear();
  for (int frame = 2; frame < 90; ++frame) {
    const std::vector<Pin>& now = at(frame * kFrame).pins;
    ASSERT_EQ(now.size(), before.size());
    for (std::size_t k = 0; k < now.size(); ++k) EXPECT_EQ(now[k].position, before[k].position);
  }
  const std::vector<std::string> said = warnings();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(says(said[0], "stays at its last pose"));
}

TEST_F(FollowedSurroundings, AGripperHoldsWhatIsBetweenItsFingers) {
  poses_["hand"] = Eigen::Isometry3d(Eigen::Translation3d(Eigen::Vector3d(rest_.colwise().minCoeff())));
  const std::size_t held = follower_.grip(boxIn("hand"), lookup(), topology_, rest_, kFrame);
  EXPECT_GT(held, 0U);
  for (const Pin& pin : at(2 * kFrame).pins) {
    const Eigen::Vector3d in_box = poses_["hand"].inverse() * pin.position;
    EXPECT_LE(in_box.cwiseAbs().maxCoeff(), 0.02 + kLimit_m);
  }
  EXPECT_EQ(follower_.lastSurroundings().pins, std::vector<std::string>(held, "gripper"));
  EXPECT_TRUE(follower_.removePin("gripper"));
  EXPECT_TRUE(at(3 * kFrame).pins.empty());
  poses_["hand"].translation().x() += 1.0;
  EXPECT_THROW(follower_.grip(boxIn("hand"), lookup(), topology_, rest_, 3 * kFrame), std::invalid_argument);
}

TEST_F(FollowedSurroundings, AGripperHoldsNothingOfABodyThatIsNotPlaced) {
  follower_.grip(boxIn("hand"), lookup(), topology_, rest_, kFrame);
  follower_.updatePins(topology_, {});
  EXPECT_TRUE(follower_.lastSurroundings().pins.empty());
}

TEST_F(FollowedSurroundings, ACutAddsItsVerticesToTheRegion) {
  poses_["hand"] = randomPose();
  const Eigen::Isometry3d before = poses_["hand"];
  follower_.addPin(endIn("hand"), topology_);
  const std::size_t held = at(kFrame).pins.size();
  Points cut(rest_.rows() + 2, 3);
  cut << rest_, Eigen::RowVector3d(0.005, 0.05, 0.01), Eigen::RowVector3d(0.1, 0.05, 0.01);
  TetTopology edited = topology_;
  edited.rest_vertices = cut;
  follower_.updatePins(edited, cut);
  EXPECT_EQ(follower_.lastSurroundings().all.pins.size(), held + 1);
  poses_["hand"] = randomPose();
  const Surroundings& now = follower_.surroundingsAt(2 * kFrame, lookup(), cut, kFrame);
  ASSERT_EQ(now.pins.size(), held + 1);
  EXPECT_EQ(now.pins.back().vertex, rest_.rows());
  const Eigen::Vector3d place = cut.row(rest_.rows());
  EXPECT_LT((now.pins.back().position - poses_["hand"] * before.inverse() * place).norm(), kLimit_m);
}

TEST_F(FollowedSurroundings, APinAndAnObstacleHaveDifferentNames) {
  follower_.addPin(endIn(""), topology_);
  EXPECT_THROW(follower_.setObstacle({"end", "", Obstacle::plane()}), std::invalid_argument);
  follower_.setObstacle({"table", "", Obstacle::plane()});
  PinRegion table = endIn("");
  table.name = "table";
  EXPECT_THROW(follower_.addPin(table, topology_), std::invalid_argument);
}

TEST_F(FollowedSurroundings, PinsOfAnotherBodyReplaceAllPins) {
  PinRegion other = endIn("");
  other.name = "other";
  TetTopology larger = topology_;
  larger.rest_vertices *= 2.0;
  follower_.addPin(endIn("hand"), topology_);
  follower_.replacePins({}, {other}, larger);
  EXPECT_EQ(follower_.pinNames(), std::vector<std::string>{"other"});
  PinRegion nowhere = endIn("");
  nowhere.min.setConstant(5.0), nowhere.max.setConstant(6.0);
  EXPECT_THROW(follower_.replacePins({}, {endIn("hand"), nowhere}, topology_), std::invalid_argument);
  EXPECT_EQ(follower_.pinNames(), std::vector<std::string>{"other"}) << "what is refused changes nothing";
  follower_.replacePins({}, {}, topology_);
  EXPECT_TRUE(at(kFrame).pins.empty());
}

TEST_F(FollowedSurroundings, PinsOfABodyThatIsPlacedHoldItsRestShape) {
  Simulator simulator(topology_, Material(), SimulatorConfig());
  follower_.addPin(endIn(""), topology_);
  TargetSet targets;
  targets.reset = true;
  targets.body_pose = randomPose();
  Target wrong;  // pulls the held end aside
  wrong.place.tet = 0;
  wrong.position = targets.body_pose * Eigen::Vector3d(rest_.row(topology_.tets(0, 0)));
  wrong.position.z() += 0.005;
  wrong.place.barycentric = {1.0, 0.0, 0.0, 0.0};
  targets.targets = {wrong};
  const std::vector<Pin> pins =
      follower_.surroundingsAt(kFrame, lookup(), verticesToHold(targets, simulator), kFrame).pins;
  simulator.step(targets, kFrame, follower_.lastSurroundings().all);
  ASSERT_FALSE(pins.empty());
  for (const Pin& pin : pins) {
    const Eigen::Vector3d rest = rest_.row(pin.vertex);
    EXPECT_LT((pin.position - targets.body_pose * rest).norm(), kLimit_m);
  }
  EXPECT_EQ(verticesToHold(targets, simulator).rows(), 0);  // it may be deformed now
}

/// A sensor in the frame feels the weight, and its moment about the frame's origin.
TEST_F(FollowedSurroundings, AStillBodyLoadsItsPinWithItsWeight) {
  SimulatorConfig config;
  config.solver = SolverKind::kFem;
  config.iterations = 1000;
  config.tolerance = 1e-8;
  config.gravity = {0.0, 0.0, -9.81};
  const Material material;
  Simulator simulator(topology_, material, config);
  TargetSet reset;
  reset.reset = true;
  simulator.step(reset, 0);
  poses_["hand"] = randomPose();
  follower_.addPin(endIn("hand"), topology_);
  const Surroundings& surroundings =
      follower_.surroundingsAt(kFrame, lookup(), simulator.state().vertices, 0);
  simulator.settle({}, surroundings);
  const std::vector<NamedReaction> reactions = follower_.named(simulator.reactions());
  ASSERT_EQ(reactions.size(), 1U);
  EXPECT_EQ(reactions[0].name, "end");
  EXPECT_EQ(reactions[0].frame, "hand");
  const Eigen::Vector3d weight = 0.2 * 0.1 * 0.03 * material.density_kg_m3 * config.gravity;
  const Eigen::Matrix3d R = poses_["hand"].linear();
  EXPECT_LT((R * reactions[0].wrench.force - weight).norm(), 1e-4 * weight.norm());
  // The line of action of the weight passes through the centre of mass.
  const Eigen::Vector3d torque = R * reactions[0].wrench.torque;  // about the origin of the frame
  const Eigen::Vector3d arm = weight.cross(torque) / weight.squaredNorm();
  const Eigen::Vector3d center = poses_["hand"].translation() + arm;
  EXPECT_NEAR(torque.dot(weight), 0.0, 1e-4 * weight.squaredNorm());
  EXPECT_GT(center.x(), 0.05);
  EXPECT_LT(center.x(), 0.1);  // it sags
  EXPECT_NEAR(center.y(), 0.05, 1e-3);
}

}  // namespace
}  // namespace softbody
