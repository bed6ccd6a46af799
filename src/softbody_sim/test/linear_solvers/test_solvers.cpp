#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "fixtures/placed_sponge.h"

namespace softbody {
namespace {

using testing::kFrame;
using testing::largestDistance;
using testing::PlacedSponge;
using testing::somePose;
using testing::sponge;
using testing::targetsOf;
using testing::vertexTargets;

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
    PlacedSponge simulator(Eigen::Isometry3d::Identity(), withDamping(0.3), configOf(GetParam()));
    simulator.setVertices(start);
    for (int frame = 1; frame <= frames; ++frame) {
      simulator.step({}, frame * kFrame);
      EXPECT_TRUE(simulator.vertices().allFinite());
    }
    const Points& end = simulator.vertices();
    return largestDistance(end, transformed(simulator.rest(), fitRigid(simulator.rest(), end)));
  }
};

TEST_P(Solvers, StayAtRest) {
  PlacedSponge simulator(somePose(), Material(), configOf(GetParam()));
  for (int frame = 1; frame <= 30; ++frame) simulator.step({}, frame * kFrame);
  EXPECT_LT(largestDistance(simulator.vertices(), transformed(simulator.rest(), somePose())), 1e-12);
  EXPECT_TRUE(simulator.report().converged);
}

/// Projective dynamics also where it has not converged.
TEST_P(Solvers, KeepLinearMomentum) {
  const bool pd = GetParam().solver == SolverKind::kProjectiveDynamics;
  PlacedSponge simulator(somePose(), withDamping(0.0),
                         pd ? SimulatorConfig() : configOf(GetParam(), 100, 1e-8));
  const TetTopology& topology = simulator.topology();
  TargetSet pull = targetsOf(vertexTargets(topology, topology.rest_vertices));
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
  for (int frame = 2; frame <= 100; ++frame) {
    const Points before = simulator.vertices();
    simulator.step({}, frame * kFrame);
    const Eigen::RowVector3d momentum = masses.transpose() * (simulator.vertices() - before);
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
  Points goal = topology.rest_vertices;
  goal.col(2) += 4.0 * goal.col(0).cwiseAbs2();
  TargetSet bend = targetsOf(vertexTargets(topology, goal));
  bend.targets.resize(60);
  const auto atRest = [&](SolverKind solver) {
    SimulatorConfig config = configOf({"", solver, Elasticity::kCorotated}, 500, 1e-9);
    config.strain_smoothing = 0.0;
    PlacedSponge simulator(Eigen::Isometry3d::Identity(), withDamping(1.0), config);
    for (int frame = 1; frame <= 60; ++frame) simulator.step(bend, frame * kFrame);
    return simulator.vertices();
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
