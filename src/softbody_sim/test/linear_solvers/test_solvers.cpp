#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::largestDistance;
using testing::placing;
using testing::somePose;
using testing::sponge;
using testing::vertexTargets;

constexpr Nanoseconds kFrame = 33333333;

struct Solver {
  const char* name;
  SolverKind solver;
  Elasticity elasticity;
};

SimulatorConfig configOf(const Solver& solver, int iterations = 20, double tolerance = 1e-4) {
  SimulatorConfig config;
  config.solver = solver.solver;
  config.elasticity = solver.elasticity;
  config.iterations = iterations;
  config.tolerance = tolerance;
  return config;
}

Material withDamping(double damping) {
  Material material;
  material.damping = damping;
  return material;
}

/// Properties of every solver.
class Solvers : public ::testing::TestWithParam<Solver> {
 protected:
  /// Steps without targets from a shape without velocity. @return distance of the final shape from the rest
  /// shape [m].
  double misshapedAfter(int frames, const Points& start) {
    const TetTopology topology = sponge();
    Simulator simulator(topology, withDamping(0.3), configOf(GetParam()));
    simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
    simulator.setVertices(start);
    for (int frame = 1; frame <= frames; ++frame) {
      simulator.step({}, frame * kFrame);
      EXPECT_TRUE(simulator.state().vertices.allFinite());
    }
    const Points& end = simulator.state().vertices;
    return largestDistance(end, transformed(topology.rest_vertices, fitRigid(topology.rest_vertices, end)));
  }
};

TEST_P(Solvers, StayAtRest) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, Material(), configOf(GetParam()));
  simulator.step(placing(somePose()), 0);
  for (int frame = 1; frame <= 10; ++frame) simulator.step({}, frame * kFrame);
  EXPECT_LT(largestDistance(simulator.state().vertices, transformed(topology.rest_vertices, somePose())),
            1e-12);
  EXPECT_TRUE(simulator.report().converged);
}

TEST_P(Solvers, KeepLinearMomentum) {
  const TetTopology topology = sponge();
  Simulator simulator(topology, withDamping(0.0), configOf(GetParam(), 100, 1e-8));
  simulator.step(placing(somePose()), 0);
  TargetSet pull;
  pull.targets = vertexTargets(topology, topology.rest_vertices);
  pull.targets.resize(20);
  for (Target& target : pull.targets)
    target.position = somePose() * target.position + Eigen::Vector3d(0.01, 0.0, 0.02);
  simulator.step(pull, kFrame);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(topology.rest_vertices.rows());
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  for (Eigen::Index t = 0; t < volumes.size(); ++t) {
    for (int k = 0; k < 4; ++k) masses[topology.tets(t, k)] += volumes[t];
  }
  Eigen::RowVector3d start = Eigen::RowVector3d::Zero();
  for (int frame = 2; frame <= 40; ++frame) {
    const Points before = simulator.state().vertices;
    simulator.step({}, frame * kFrame);
    const Eigen::RowVector3d momentum = masses.transpose() * (simulator.state().vertices - before);
    if (frame == 2) start = momentum;
    EXPECT_LT((momentum - start).norm(), 1e-9 * start.norm()) << frame;
  }
}

TEST_P(Solvers, ReturnFromCrushedFlat) {
  Points flat = sponge().rest_vertices;
  flat.col(2).setConstant(0.01);
  EXPECT_LT(misshapedAfter(150, flat), 1e-4);
}

TEST_P(Solvers, ReturnFromInsideOut) { EXPECT_LT(misshapedAfter(150, -sponge().rest_vertices), 1e-4); }

TEST_P(Solvers, ReturnFromRandomVertices) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937 random(seed);
    EXPECT_LT(misshapedAfter(150, testing::randomPoints(sponge().rest_vertices.rows(), 0.1, &random)), 1e-4)
        << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Solvers,
    ::testing::Values(Solver{"Pd", SolverKind::kProjectiveDynamics, Elasticity::kCorotated},
                      Solver{"FemCorotated", SolverKind::kFem, Elasticity::kCorotated},
                      Solver{"FemNeoHookean", SolverKind::kFem, Elasticity::kNeoHookean}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(SolverChoice, PdAndFemAgreeAtRestUnderTheSameEnergy) {
  const TetTopology topology = sponge();
  TargetSet bend;
  Points goal = topology.rest_vertices;
  goal.col(2) += 4.0 * goal.col(0).cwiseAbs2();
  bend.targets = vertexTargets(topology, goal);
  bend.targets.resize(60);
  const auto atRest = [&](SolverKind solver) {
    SimulatorConfig config = configOf({"", solver, Elasticity::kCorotated}, 500, 1e-9);
    config.strain_smoothing = 0.0;
    Simulator simulator(topology, withDamping(1.0), config);
    simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
    for (int frame = 1; frame <= 60; ++frame) simulator.step(bend, frame * kFrame);
    return simulator.state().vertices;
  };
  const Points pd = atRest(SolverKind::kProjectiveDynamics), fem = atRest(SolverKind::kFem);
  EXPECT_GT(largestDistance(fem, topology.rest_vertices), 0.02);
  EXPECT_LT(largestDistance(pd, fem), 1e-6);
}

TEST(SolverChoice, SpringsNeedFemWithoutSmoothing) {
  for (const char* refused : {"{elasticity: springs}", "{solver: fem, elasticity: springs}",
                              "{solver: fem, elasticity: springs, strain_smoothing: 0.0}"}) {
    Parameters parameters(YAML::Load(refused), "/simulator/");
    EXPECT_THROW(simulatorParameters().read(parameters), std::invalid_argument) << refused;
  }
  Parameters good(
      YAML::Load("{solver: fem, elasticity: springs, strain_smoothing: 0.0, volume_smoothing: 0.0}"),
      "/simulator/");
  EXPECT_EQ(simulatorParameters().read(good).elasticity, Elasticity::kSprings);
}

TEST(SolverChoice, NeoHookeanNeedsFem) {
  Parameters parameters(YAML::Load("{elasticity: neo_hookean}"), "/simulator/");
  EXPECT_THROW(simulatorParameters().read(parameters), std::invalid_argument);
  Parameters good(YAML::Load("{solver: fem, elasticity: neo_hookean}"), "/simulator/");
  EXPECT_EQ(simulatorParameters().read(good).elasticity, Elasticity::kNeoHookean);
}

}  // namespace
}  // namespace softbody
