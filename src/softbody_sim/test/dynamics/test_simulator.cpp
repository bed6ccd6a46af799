#include <gtest/gtest.h>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::kFrame;
using testing::largestDistance;
using testing::placing;
using testing::somePose;
using testing::sponge;
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

Eigen::VectorXd massesOf(const TetTopology& topology, double density) {
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(topology.rest_vertices.rows());
  for (Eigen::Index t = 0; t < volumes.size(); ++t) {
    for (int k = 0; k < 4; ++k) masses[topology.tets(t, k)] += density * volumes[t] / 4.0;
  }
  return masses;
}

/// Targets at the surface's vertices that act only along the surface's normal.
std::vector<Target> slidingTargets(const TetTopology& topology, const Points& positions) {
  const Points normals = vertexNormals(positions, topology.surface);
  std::vector<Target> targets = vertexTargets(topology, positions);
  for (std::size_t v = 0; v < targets.size(); ++v)
    targets[v].normal = normals.row(static_cast<Eigen::Index>(v));
  return targets;
}

TEST(Simulator, StaysAtRest) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), SimulatorConfig());
  simulator.step(placing(somePose()), 0);
  const Points placed = transformed(topology.rest_vertices, somePose());
  EXPECT_LT(largestDistance(simulator.state().vertices, placed), 1e-12);
  for (int frame = 1; frame <= 30; ++frame) simulator.step({}, frame * kFrame);
  EXPECT_LT(largestDistance(simulator.state().vertices, placed), 1e-12);
  EXPECT_TRUE(simulator.report().converged);
}

TEST(Simulator, FollowsTargetsOfARigidMotion) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), accurate());
  simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
  TargetSet targets;
  const Points goal = transformed(topology.rest_vertices, somePose());
  targets.targets = vertexTargets(topology, goal);
  for (int frame = 1; frame <= 40; ++frame) simulator.step(targets, frame * kFrame);
  EXPECT_LT(largestDistance(simulator.state().vertices, goal), 1e-7);
}

TEST(Simulator, ReachesTargetsFortyMillimetresAwayInOneStep) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), SimulatorConfig());
  simulator.step(placing(somePose()), 0);
  TargetSet targets;
  const Eigen::Isometry3d moved = Eigen::Translation3d(0.025, -0.025, 0.02) * somePose() *
                                  Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.3, 0.2, 1.0).normalized());
  const Points goal = transformed(topology.rest_vertices, moved);
  targets.targets = vertexTargets(topology, goal);
  simulator.step(targets, kFrame);
  EXPECT_LT(largestDistance(simulator.state().vertices, goal), 1e-4);
}

TEST(Simulator, SurvivesContradictoryTargets) {
  const TetTopology topology = sponge();
  std::mt19937 random(1);
  Simulator simulator(topology, Material(), SimulatorConfig());
  simulator.step(placing(somePose()), 0);
  TargetSet targets;
  targets.targets =
      vertexTargets(topology, testing::randomPoints(topology.rest_vertices.rows(), 0.3, &random));
  for (int frame = 1; frame <= 5; ++frame) simulator.step(targets, frame * kFrame);
  EXPECT_TRUE(simulator.state().vertices.allFinite());
  for (int frame = 6; frame <= 200; ++frame) simulator.step({}, frame * kFrame);
  const Eigen::Isometry3d pose = fitRigid(topology.rest_vertices, simulator.state().vertices);
  EXPECT_LT(largestDistance(simulator.state().vertices, transformed(topology.rest_vertices, pose)), 1e-3);
}

TEST(Simulator, SlidesAlongTargetsWithNormals) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, undamped(), accurate());
  simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
  // Planes hold z at every bottom vertex; one corner pulled sideways moves the whole body.
  TargetSet targets;
  for (Target target : vertexTargets(topology, topology.rest_vertices)) {
    if (target.position.z() > 1e-9) continue;
    target.normal = Eigen::Vector3d::UnitZ();
    targets.targets.push_back(target);
  }
  Target pull = targets.targets.front();
  pull.position += Eigen::Vector3d(0.02, 0.01, 0.0);
  pull.normal.setZero();
  targets.targets.push_back(pull);
  const auto moved = [&] {
    return (simulator.state().vertices.colwise().mean() - topology.rest_vertices.colwise().mean()).norm();
  };
  for (int frame = 1; frame <= 600 && moved() < 0.011; ++frame) {
    simulator.step(targets, frame * kFrame);
    for (const Target& target : targets.targets) {
      const Eigen::Vector3d offset =
          positionOf(target.place, simulator.state().vertices, topology.tets) - target.position;
      EXPECT_LT(std::abs(offset.z()), 2e-4);
    }
  }
  EXPECT_GT(moved(), 0.01);
}

TEST(Simulator, IsHeldByNormalTargetsAllAround) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), accurate());
  simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
  const Eigen::Isometry3d moved =
      Eigen::Translation3d(0.004, -0.003, 0.005) * Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ());
  const Points goal = transformed(topology.rest_vertices, moved);
  TargetSet targets;
  targets.targets = slidingTargets(topology, goal);
  for (int frame = 1; frame <= 30; ++frame) simulator.step(targets, frame * kFrame);
  EXPECT_LT(largestDistance(simulator.state().vertices, goal), 1e-6);
}

TEST(Simulator, KeepsLinearMomentum) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, undamped(), SimulatorConfig());
  simulator.step(placing(somePose()), 0);
  TargetSet pull;
  pull.targets = vertexTargets(
      topology, transformed(topology.rest_vertices, Eigen::Translation3d(0.01, 0.0, 0.02) * somePose()));
  pull.targets.resize(20);
  simulator.step(pull, kFrame);
  const Eigen::VectorXd masses = massesOf(topology, undamped().density_kg_m3);
  const auto momentum = [&](const Points& before) {
    return Eigen::RowVector3d(masses.transpose() * (simulator.state().vertices - before) / (1e-9 * kFrame));
  };
  Points before = simulator.state().vertices;
  simulator.step({}, 2 * kFrame);
  const Eigen::RowVector3d start = momentum(before);
  EXPECT_GT(start.norm(), 1e-4);
  for (int frame = 3; frame <= 100; ++frame) {
    before = simulator.state().vertices;
    simulator.step({}, frame * kFrame);
    EXPECT_LT((momentum(before) - start).norm(), 1e-9 * start.norm());
  }
}

TEST(Simulator, DampingReducesTheVelocity) {
  const TetTopology topology = sponge();
  Material material;
  material.damping = 0.25;
  SimulatorConfig config = accurate();
  config.gravity = {0.0, 0.0, -9.81};
  Simulator simulator(topology, material, config);
  simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
  const Nanoseconds frame = 1000000000 / 30;
  double velocity = 0.0;
  for (int k = 1; k <= 10; ++k) {
    const double before = simulator.state().vertices.col(2).mean();
    simulator.step({}, k * frame);
    velocity = 0.75 * velocity - 9.81 / 30.0;
    EXPECT_NEAR(simulator.state().vertices.col(2).mean() - before, velocity / 30.0, 1e-6);
  }
}

TEST(Simulator, ClampsLongGapsAndElapsesNoTimeForARepeatedStamp) {
  const TetTopology topology = sponge();
  SimulatorConfig config;
  config.gravity = {0.0, 0.0, -10.0};
  Simulator simulator(topology, undamped(), config);
  simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
  simulator.step({}, 5000000000);
  const Points fallen = simulator.state().vertices;
  EXPECT_NEAR(fallen(0, 2) - topology.rest_vertices(0, 2), -0.1, 1e-9);
  simulator.step({}, 5000000000);
  EXPECT_LT(largestDistance(simulator.state().vertices, fallen), 1e-12);
}

TEST(Simulator, KeepsNoExcessVelocityAfterAGap) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, undamped(), accurate());
  simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
  const Eigen::Vector3d way(0.05, 0.0, 0.0);
  TargetSet targets;
  targets.targets = vertexTargets(
      topology, transformed(topology.rest_vertices, Eigen::Isometry3d(Eigen::Translation3d(way))));
  constexpr Nanoseconds kGap = 2000000000;
  simulator.step(targets, kGap);
  const Points before = simulator.state().vertices;
  const double reached = (before - topology.rest_vertices).col(0).mean();
  EXPECT_GT(reached, 0.045);
  simulator.step({}, kGap + kFrame);
  // It continues at the mean speed of the gap.
  const double on = (simulator.state().vertices - before).col(0).mean();
  EXPECT_NEAR(on, reached * static_cast<double>(kFrame) / static_cast<double>(kGap), 1e-6);
}

TEST(Simulator, RunsTheSameTwice) {
  const auto run = [] {
    const TetTopology topology = sponge();
    Simulator simulator(topology, Material(), SimulatorConfig());
    simulator.step(placing(somePose()), 0);
    std::mt19937 random(9);
    for (int frame = 1; frame <= 10; ++frame) {
      TargetSet targets;
      const Points noise = testing::randomPoints(topology.rest_vertices.rows(), 0.005, &random);
      targets.targets = slidingTargets(topology, transformed(topology.rest_vertices, somePose()) + noise);
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

  TargetSet targets;
  targets.targets = {vertexTargets(topology, topology.rest_vertices).front()};
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
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), SimulatorConfig());
  simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
  TargetSet targets;
  targets.targets = vertexTargets(topology, topology.rest_vertices);
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
