#include <gtest/gtest.h>

#include "fixtures/placed_sponge.h"

namespace softbody {
namespace {

using testing::kFrame;
using testing::largestDistance;
using testing::PlacedSponge;
using testing::placing;
using testing::somePose;
using testing::sponge;
using testing::targetsOf;
using testing::vertexTargets;

TEST(Simulator, RefusesUnusableTargetsAndKeepsItsState) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), SimulatorConfig());
  EXPECT_FALSE(simulator.placed());
  EXPECT_THROW(simulator.step({}, 0), std::invalid_argument);
  simulator.step(placing(somePose()), 0);
  const Points placed = simulator.state().vertices;

  const Target good = vertexTargets(topology, placed).front();
  const auto refuses = [&](TargetSet targets, const Target& target) {
    targets.targets = {good, target};
    EXPECT_THROW(simulator.step(targets, kFrame), std::invalid_argument);
    EXPECT_TRUE(simulator.state().vertices == placed);
  };
  TargetSet other_revision;
  other_revision.revision = 1;
  refuses(other_revision, good);
  Target bad = good;
  bad.place.tet = static_cast<int>(topology.tets.rows());
  refuses({}, bad);
  bad = good;
  bad.position.x() = std::nan("");
  refuses({}, bad);
  bad = good;
  bad.weight = -1.0;
  refuses(placing(Eigen::Isometry3d::Identity()), bad);
  bad = good;
  bad.weight = 1.01e6;
  refuses({}, bad);
  bad = good;
  bad.place.barycentric = {1e12, -1e12, 1.0, 0.0};
  refuses(placing(Eigen::Isometry3d::Identity()), bad);

  simulator.reset();
  EXPECT_FALSE(simulator.placed());
  EXPECT_EQ(simulator.state().vertices.rows(), 0);
}

TEST(Simulator, RefusesTargetsThatAreNotOfTheBody) {
  PlacedSponge simulator(somePose());
  const Points placed = simulator.vertices();
  TargetSet targets = targetsOf(vertexTargets(simulator.topology(), placed));
  targets.body_pose = somePose();
  for (const double far : {5.0, 1e4, 1e10, 1e20, 1e300}) {
    TargetSet bad = targets;
    bad.targets[7].position.y() = far;
    EXPECT_THROW(simulator.step(bad, kFrame), std::invalid_argument) << far;
    EXPECT_TRUE(simulator.state().vertices == placed) << far;
    EXPECT_FALSE(simulator.hasLeft(bad)) << "one outlier is not the body";
  }
  // A program by hand may move the body without a body_pose.
  targets.body_pose.setIdentity();
  for (Target& target : targets.targets) target.position.x() += 0.3;
  EXPECT_NO_THROW(simulator.step(targets, kFrame));
}

/// In whatever way the body was driven away: targets that agree with their body_pose bring it back.
TEST(Simulator, ABodyThatWasDrivenAwayIsBroughtBack) {
  const TetTopology topology = sponge();
  TargetSet targets = targetsOf(vertexTargets(topology, transformed(topology.rest_vertices, somePose())));
  targets.body_pose = somePose();
  for (const double away : {3.0, 1e4, 1e17}) {
    Simulator simulator(topology, Material(), SimulatorConfig());
    EXPECT_FALSE(simulator.hasLeft(targets)) << "not placed";
    simulator.step(placing(somePose()), 0);
    EXPECT_FALSE(simulator.hasLeft(targets));
    simulator.setVertices(simulator.state().vertices.rowwise() + Eigen::RowVector3d(away, 0.0, 0.0));
    ASSERT_TRUE(simulator.hasLeft(targets)) << away;
    TargetSet again = targets;
    again.reset = true;
    simulator.step(again, kFrame);
    EXPECT_LT(largestDistance(simulator.state().vertices, transformed(topology.rest_vertices, somePose())),
              1e-4);
  }
}

/// With stiffer targets, rounding would move the body.
TEST(Simulator, TheStiffestTargetsLeaveABodyAtRestWhereItIs) {
  const TetTopology topology = sponge();
  std::mt19937 random(6);
  for (bool single : {false, true}) {
    for (int history : {0, 5}) {
      SimulatorConfig config;
      config.single_precision = single;
      config.lbfgs_history = history;
      Simulator simulator(topology, Material(), config);
      TargetSet targets = placing(Eigen::Isometry3d::Identity());
      targets.targets = vertexTargets(topology, topology.rest_vertices);
      for (Target& target : targets.targets) {
        target.weight = largestStiffness(config) / config.target_stiffness;
        target.normal = testing::randomPoints(1, 1.0, &random).transpose().normalized();
      }
      for (int frame = 0; frame < 30; ++frame) {
        simulator.step(targets, frame * kFrame);
        targets.reset = false;
      }
      const Points moved = simulator.state().vertices - topology.rest_vertices;
      EXPECT_LT(moved.cwiseAbs().maxCoeff(), single ? 2e-4 : 1e-6) << "history " << history;
    }
  }
}

TEST(Simulator, AFailedStepChangesNothing) {
  SimulatorConfig config;
  config.gravity = {0.0, 0.0, -9.81};
  PlacedSponge failing(somePose(), Material(), config), untouched(somePose(), Material(), config);
  for (Simulator* simulator : {&failing, &untouched}) simulator->step({}, kFrame);
  Surroundings impossible;
  impossible.loads = Points::Constant(failing.rest().rows(), 3, 1e308);
  EXPECT_THROW(failing.step(placing(Eigen::Isometry3d::Identity()), 2 * kFrame, impossible),
               std::runtime_error);
  for (int frame = 2; frame <= 4; ++frame) {
    EXPECT_TRUE(failing.state().vertices == untouched.state().vertices) << frame;
    for (Simulator* simulator : {&failing, &untouched}) simulator->step({}, frame * kFrame);
  }
}

TEST(Simulator, RefusesVerticesThatNoTetUses) {
  TetTopology topology = sponge();
  topology.rest_vertices.conservativeResize(topology.rest_vertices.rows() + 1, Eigen::NoChange);
  topology.rest_vertices.bottomRows<1>().setZero();
  EXPECT_THROW(Simulator(topology, Material(), SimulatorConfig()), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
