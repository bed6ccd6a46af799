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

Material undamped() {
  Material material;
  material.damping = 0.0;
  return material;
}

SimulatorConfig accurate() {
  SimulatorConfig config;
  config.iterations = 300;
  config.tolerance = 1e-7;
  return config;
}

/// Targets at the surface's vertices that act only along the surface's normal.
std::vector<Target> slidingTargets(const TetTopology& topology, const Points& positions) {
  const Points normals = vertexNormals(positions, topology.surface);
  std::vector<Target> targets = vertexTargets(topology, positions);
  for (std::size_t v = 0; v < targets.size(); ++v)
    targets[v].normal = normals.row(static_cast<Eigen::Index>(v));
  return targets;
}

TEST(Simulator, FollowsTargetsOfARigidMotion) {
  PlacedSponge simulator(Eigen::Isometry3d::Identity(), Material(), accurate());
  const Points goal = transformed(simulator.rest(), somePose());
  TargetSet targets = targetsOf(vertexTargets(simulator.topology(), goal));
  for (int frame = 1; frame <= 40; ++frame) simulator.step(targets, frame * kFrame);
  EXPECT_LT(largestDistance(simulator.vertices(), goal), 1e-7);
}

TEST(Simulator, ReachesTargetsFortyMillimetresAwayInOneStep) {
  PlacedSponge simulator(somePose());
  const Eigen::Isometry3d moved = Eigen::Translation3d(0.025, -0.025, 0.02) * somePose() *
                                  Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.3, 0.2, 1.0).normalized());
  const Points goal = transformed(simulator.rest(), moved);
  TargetSet targets = targetsOf(vertexTargets(simulator.topology(), goal));
  simulator.step(targets, kFrame);
  EXPECT_LT(largestDistance(simulator.vertices(), goal), 1e-4);
}

TEST(Simulator, SurvivesContradictoryTargets) {
  std::mt19937 random(1);
  PlacedSponge simulator(somePose());
  TargetSet targets = targetsOf(
      vertexTargets(simulator.topology(), testing::randomPoints(simulator.rest().rows(), 0.3, &random)));
  for (int frame = 1; frame <= 5; ++frame) simulator.step(targets, frame * kFrame);
  EXPECT_TRUE(simulator.vertices().allFinite());
  for (int frame = 6; frame <= 200; ++frame) simulator.step({}, frame * kFrame);
  const Eigen::Isometry3d pose = fitRigid(simulator.rest(), simulator.vertices());
  EXPECT_LT(largestDistance(simulator.vertices(), transformed(simulator.rest(), pose)), 1e-3);
}

TEST(Simulator, SlidesAlongTargetsWithNormals) {
  PlacedSponge simulator(Eigen::Isometry3d::Identity(), undamped(), accurate());
  // Planes hold z at every bottom vertex; one corner pulled sideways moves the whole body.
  TargetSet targets;
  for (Target target : vertexTargets(simulator.topology(), simulator.rest())) {
    if (target.position.z() > 1e-9) continue;
    target.normal = Eigen::Vector3d::UnitZ();
    targets.targets.push_back(target);
  }
  Target pull = targets.targets.front();
  pull.position += Eigen::Vector3d(0.02, 0.01, 0.0);
  pull.normal.setZero();
  targets.targets.push_back(pull);
  const auto moved = [&] {
    return (simulator.vertices().colwise().mean() - simulator.rest().colwise().mean()).norm();
  };
  for (int frame = 1; frame <= 600 && moved() < 0.011; ++frame) {
    simulator.step(targets, frame * kFrame);
    for (const Target& target : targets.targets) {
      const Eigen::Vector3d offset =
          positionOf(target.place, simulator.vertices(), simulator.topology().tets) - target.position;
      EXPECT_LT(std::abs(offset.z()), 2e-4);
    }
  }
  EXPECT_GT(moved(), 0.01);
}

TEST(Simulator, IsHeldByNormalTargetsAllAround) {
  PlacedSponge simulator(Eigen::Isometry3d::Identity(), Material(), accurate());
  const Eigen::Isometry3d moved =
      Eigen::Translation3d(0.004, -0.003, 0.005) * Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ());
  const Points goal = transformed(simulator.rest(), moved);
  TargetSet targets = targetsOf(slidingTargets(simulator.topology(), goal));
  for (int frame = 1; frame <= 30; ++frame) simulator.step(targets, frame * kFrame);
  EXPECT_LT(largestDistance(simulator.vertices(), goal), 1e-6);
}

TEST(Simulator, DampingReducesTheVelocity) {
  Material material;
  material.damping = 0.25;
  SimulatorConfig config = accurate();
  config.gravity = {0.0, 0.0, -9.81};
  PlacedSponge simulator(Eigen::Isometry3d::Identity(), material, config);
  const Nanoseconds frame = 1000000000 / 30;
  double velocity = 0.0;
  for (int k = 1; k <= 10; ++k) {
    const double before = simulator.vertices().col(2).mean();
    simulator.step({}, k * frame);
    velocity = 0.75 * velocity - 9.81 / 30.0;
    EXPECT_NEAR(simulator.vertices().col(2).mean() - before, velocity / 30.0, 1e-6);
  }
}

TEST(Simulator, ClampsLongGapsAndElapsesNoTimeForARepeatedStamp) {
  SimulatorConfig config;
  config.gravity = {0.0, 0.0, -10.0};
  PlacedSponge simulator(Eigen::Isometry3d::Identity(), undamped(), config);
  simulator.step({}, 5000000000);
  const Points fallen = simulator.vertices();
  EXPECT_NEAR(fallen(0, 2) - simulator.rest()(0, 2), -0.1, 1e-9);
  simulator.step({}, 5000000000);
  EXPECT_LT(largestDistance(simulator.vertices(), fallen), 1e-12);
}

TEST(Simulator, KeepsNoExcessVelocityAfterAGap) {
  PlacedSponge simulator(Eigen::Isometry3d::Identity(), undamped(), accurate());
  const Eigen::Vector3d way(0.05, 0.0, 0.0);
  TargetSet targets = targetsOf(vertexTargets(
      simulator.topology(), transformed(simulator.rest(), Eigen::Isometry3d(Eigen::Translation3d(way)))));
  constexpr Nanoseconds kGap = 2000000000;
  simulator.step(targets, kGap);
  const Points before = simulator.vertices();
  const double reached = (before - simulator.rest()).col(0).mean();
  EXPECT_GT(reached, 0.045);
  simulator.step({}, kGap + kFrame);
  // It continues at the mean speed of the gap.
  const double on = (simulator.vertices() - before).col(0).mean();
  EXPECT_NEAR(on, reached * static_cast<double>(kFrame) / static_cast<double>(kGap), 1e-6);
}

TEST(Simulator, RunsTheSameTwice) {
  const auto run = [] {
    PlacedSponge simulator(somePose());
    std::mt19937 random(9);
    for (int frame = 1; frame <= 10; ++frame) {
      const Points noise = testing::randomPoints(simulator.rest().rows(), 0.005, &random);
      TargetSet targets =
          targetsOf(slidingTargets(simulator.topology(), transformed(simulator.rest(), somePose()) + noise));
      simulator.step(targets, frame * kFrame);
    }
    return simulator.state();
  };
  const MeshState a = run(), b = run();
  EXPECT_TRUE(a.vertices == b.vertices);
  EXPECT_EQ(a.confidence, b.confidence);
  EXPECT_EQ(a.standard_deviation, b.standard_deviation);
}

TEST(Simulator, ConfidenceIsOneWhereObservedAndDecaysFromThere) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), SimulatorConfig());
  simulator.step(placing(Eigen::Isometry3d::Identity()), 100);
  EXPECT_EQ(simulator.state().observed, 0);
  for (float confidence : simulator.state().confidence) EXPECT_EQ(confidence, 0.0f);

  const TargetSet targets = targetsOf({vertexTargets(topology, topology.rest_vertices).front()});
  simulator.step(targets, 100 + kFrame);
  EXPECT_EQ(simulator.state().observed, 100 + kFrame);
  const std::vector<float>& confidence = simulator.state().confidence;
  EXPECT_EQ(confidence.front(), 1.0f);
  for (std::size_t v = 1; v < confidence.size(); ++v) {
    EXPECT_LT(confidence[v], 1.0f);
    EXPECT_GT(confidence[v], 0.0f);
  }
  EXPECT_LT(confidence.back(), 0.05f);
  simulator.step({}, 100 + 2 * kFrame);
  EXPECT_EQ(simulator.state().observed, 100 + kFrame);
}

TEST(Simulator, PriorsAreNoObservation) {
  PlacedSponge simulator(Eigen::Isometry3d::Identity());
  TargetSet targets = targetsOf(vertexTargets(simulator.topology(), simulator.rest()));
  simulator.step(targets, kFrame);
  const MeshState seen = simulator.state();
  ASSERT_EQ(seen.standard_deviation.size(), seen.confidence.size());
  for (Target& target : targets.targets) target.kind = TargetKind::kPrior;
  simulator.step(targets, 2 * kFrame);
  for (std::size_t v = 0; v < seen.confidence.size(); ++v) {
    EXPECT_EQ(seen.confidence[v], 1.0f);
    EXPECT_EQ(simulator.state().confidence[v], 0.0f);
    EXPECT_GT(simulator.state().standard_deviation[v], 2.0f * seen.standard_deviation[v]);
  }
}

}  // namespace
}  // namespace softbody
