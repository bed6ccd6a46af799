#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <set>
#include <string>

#include "cage/volume_maker.h"
#include "fixtures/model_files.h"
#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/io/tet_files.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::sponge;

struct Solver {
  const char* name;
  SolverKind solver;
  Elasticity elasticity;
};

TargetSet placing() {
  TargetSet targets;
  targets.reset = true;
  return targets;
}

/// Motions and equilibria with known solutions.
class KnownSolutions : public ::testing::TestWithParam<Solver> {
 protected:
  KnownSolutions() {
    config_.solver = GetParam().solver;
    config_.elasticity = GetParam().elasticity;
    config_.iterations = 5000;
    config_.tolerance = 1e-8;
    material_.damping = 0.0;
  }
  std::unique_ptr<Simulator> placed(const TetTopology& topology) const {
    auto simulator = std::make_unique<Simulator>(topology, material_, config_);
    simulator->step(placing(), 0);
    return simulator;
  }
  /// Angular momentum of a spinning sponge about its centre, per unit of density.
  static double spinOf(const Simulator& simulator, const Points& velocity) {
    const Points& x = simulator.state().vertices;
    const Eigen::VectorXd volumes = tetVolumes(simulator.topology().rest_vertices, simulator.topology().tets);
    Eigen::Vector3d spin = Eigen::Vector3d::Zero();
    for (Eigen::Index t = 0; t < volumes.size(); ++t) {
      for (int k = 0; k < 4; ++k) {
        const int v = simulator.topology().tets(t, k);
        spin += 0.25 * volumes[t] * Eigen::Vector3d(x.row(v)).cross(Eigen::Vector3d(velocity.row(v)));
      }
    }
    return spin.norm();
  }
  /// Fraction of the angular momentum that a freely spinning sponge loses in 0.2 s.
  double spinLost(int steps_per_second) const {
    const TetTopology topology = sponge();
    const auto simulator = placed(topology);
    Surroundings couple;
    couple.loads = Points::Zero(topology.rest_vertices.rows(), 3);
    for (Eigen::Index v = 0; v < couple.loads.rows(); ++v)
      couple.loads.row(v) << 0.05 - topology.rest_vertices(v, 1), topology.rest_vertices(v, 0) - 0.1, 0.0;
    couple.loads *= 0.005;
    double first = 0.0, last = 0.0;
    for (int k = 1; k <= steps_per_second * 3 / 10; ++k) {
      const Points before = simulator->state().vertices;
      const bool pushed = k <= steps_per_second / 10;
      simulator->step({}, static_cast<Nanoseconds>(1e9 * k / steps_per_second),
                      pushed ? couple : Surroundings());
      last = spinOf(*simulator, steps_per_second * (simulator->state().vertices - before));
      if (k == steps_per_second / 10) first = last;
    }
    return 1.0 - last / first;
  }
  /// A mesh whose boundary is held in a homogeneous strain: how far the inside is from it, in diagonals.
  double strainError(const TetTopology& topology) const {
    Eigen::Matrix3d F;
    F << 1.05, 0.08, 0.0, -0.03, 0.95, 0.04, 0.02, 0.0, 1.1;
    const Points& rest = topology.rest_vertices;
    const Points strained = rest * F.transpose();
    const std::set<int> boundary(topology.surface.data(), topology.surface.data() + topology.surface.size());
    EXPECT_LT(boundary.size(), static_cast<std::size_t>(rest.rows())) << "no vertex inside";
    Surroundings surroundings;
    for (const int v : boundary) surroundings.pins.push_back({v, strained.row(v)});
    const auto simulator = placed(topology);
    simulator->settle({}, surroundings);
    const double size = (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).norm();
    return (simulator->state().vertices - strained).rowwise().norm().maxCoeff() / size;
  }

  SimulatorConfig config_;
  Material material_;
};

TEST_P(KnownSolutions, AFreeBodyFallsAsImplicitEulerSays) {
  config_.gravity = {0.5, -1.0, -9.81};
  const TetTopology topology = sponge();
  const auto simulator = placed(topology);
  constexpr int kSteps = 20;
  for (int k = 1; k <= kSteps; ++k) simulator->step({}, k * 10000000);
  const Eigen::RowVector3d fall = config_.gravity * 1e-4 * kSteps * (kSteps + 1) / 2.0;
  const Points moves = simulator->state().vertices - topology.rest_vertices;
  EXPECT_LT((moves.rowwise() - fall).norm(), 1e-8);
}

TEST_P(KnownSolutions, AFreeBodyKeepsItsAngularMomentum) {
  for (const int steps_per_second : {30, 200}) EXPECT_LT(std::abs(spinLost(steps_per_second)), 2e-3);
}

TEST_P(KnownSolutions, AHomogeneousStrainIsAnEquilibriumOfAnyMesh) {
  TetTopology regular = boxTopology({5, 4, 3}, {0.5, 0.4, 0.3});
  EXPECT_LT(strainError(regular), 2e-6);
  // Tets of many shapes: every vertex moves by up to a quarter of an edge.
  std::mt19937 random(1);
  TetTopology irregular = regular;
  irregular.rest_vertices += testing::randomPoints(regular.rest_vertices.rows(), 0.015, &random);
  ASSERT_GT(tetVolumes(irregular.rest_vertices, irregular.tets).minCoeff(), 0.0);
  EXPECT_LT(strainError(irregular), 2e-6);
  // A body with a hole, as the mesher fills it.
  const TetMesh torus = volumeAround(test::torus(0.5, 0.2, 40, 16), 400);
  TetTopology meshed;
  meshed.rest_vertices = torus.vertices;
  meshed.tets = torus.tets;
  meshed.surface = boundaryTriangles(torus.tets);
  EXPECT_LT(strainError(meshed), 2e-6);
}

TEST_P(KnownSolutions, DISABLED_AHomogeneousStrainIsAnEquilibriumOfOthersMeshes) {
  for (const char* file : {"admm/box768.ele", "sofa/cylinder.msh", "sofa/cube_low_res.msh",
                           "sofa/truthcylinder1.msh", "sofa/liver.msh", "admm/torus.ele"}) {
    Warnings warnings;
    const TetMesh mesh = readTetFile(test::sharedData("meshes/tet/") + file, &warnings);
    TetTopology topology;
    topology.rest_vertices = mesh.vertices;
    topology.tets = mesh.tets;
    topology.surface = boundaryTriangles(mesh.tets);
    EXPECT_LT(strainError(topology), 2e-6) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, KnownSolutions,
    ::testing::Values(Solver{"Pd", SolverKind::kProjectiveDynamics, Elasticity::kCorotated},
                      Solver{"FemCorotated", SolverKind::kFem, Elasticity::kCorotated},
                      Solver{"FemNeoHookean", SolverKind::kFem, Elasticity::kNeoHookean}),
    [](const auto& info) { return std::string(info.param.name); });

/// Tip deflection of a 1 x 0.1 x 0.1 m beam under a small load, relative to Euler-Bernoulli theory.
double cantileverRatio(int cells_across, const SimulatorConfig& config, double poisson_ratio = 0.0) {
  constexpr double kDeflection = 1e-3;
  const TetTopology topology = boxTopology({10 * cells_across, cells_across, cells_across}, {1.0, 0.1, 0.1});
  const Material material{1e6, poisson_ratio, 1000.0, 0.0};
  Surroundings surroundings;
  std::vector<int> end;
  for (int v = 0; v < topology.rest_vertices.rows(); ++v) {
    if (topology.rest_vertices(v, 0) < 1e-9) surroundings.pins.push_back({v, topology.rest_vertices.row(v)});
    if (topology.rest_vertices(v, 0) > 1.0 - 1e-9) end.push_back(v);
  }
  surroundings.loads = Points::Zero(topology.rest_vertices.rows(), 3);
  const double force = 3.0 * kDeflection * material.youngs_modulus_pa * std::pow(0.1, 4) / 12.0;
  for (int v : end) surroundings.loads(v, 2) = force / static_cast<double>(end.size());
  Simulator simulator(topology, material, config);
  simulator.step(placing(), 0);
  simulator.settle({}, surroundings);
  double deflection = 0.0;
  for (int v : end) deflection += simulator.state().vertices(v, 2) - topology.rest_vertices(v, 2);
  return deflection / static_cast<double>(end.size()) / kDeflection;
}

TEST(Cantilever, ConvergesToEulerAndBernoulli) {
  SimulatorConfig fem;
  fem.solver = SolverKind::kFem;
  fem.tolerance = 1e-7;
  fem.strain_smoothing = 0.0;
  fem.volume_smoothing = 0.0;
  const double coarse = 1.0 - cantileverRatio(2, fem), medium = 1.0 - cantileverRatio(4, fem),
               fine = 1.0 - cantileverRatio(8, fem);
  EXPECT_LT(std::abs(fine), 0.05);
  EXPECT_GT(std::log2(coarse / medium), 1.2);
  EXPECT_GT(std::log2(medium / fine), 1.7);  // on the way to the second order of linear tets
}

/// Without smoothing, two cells across the beam reach only 0.55 of the deflection.
TEST(Cantilever, WithSmoothedStrainsACoarseBeamBendsLikeAFineOne) {
  SimulatorConfig pd;
  pd.iterations = 20000;
  pd.tolerance = 1e-9;
  EXPECT_NEAR(cantileverRatio(2, pd), 1.0, 0.1);
  EXPECT_NEAR(cantileverRatio(4, pd), 1.0, 0.05);
}

/// Also where the energy no longer tells a gain from rounding.
TEST(Cantilever, ProjectiveDynamicsBalancesForcesAtEveryStiffness) {
  const TetTopology topology = sponge();
  SimulatorConfig config;
  config.iterations = 20000;
  config.tolerance = 1e-5;
  config.gravity = {0.0, 0.0, -9.81};
  Surroundings held;
  for (int v = 0; v < topology.rest_vertices.rows(); ++v)
    if (topology.rest_vertices(v, 0) < 1e-9) held.pins.push_back({v, topology.rest_vertices.row(v)});
  for (const double youngs_modulus_pa : {1e4, 1e7, 1e10}) {
    for (const double poisson_ratio : {0.2, 0.49}) {
      Simulator simulator(topology, {youngs_modulus_pa, poisson_ratio, 30.0, 0.0}, config);
      simulator.step(placing(), 0);
      simulator.settle({}, held);
      EXPECT_TRUE(simulator.report().converged)
          << youngs_modulus_pa << ", " << poisson_ratio << ": " << simulator.report().residual_n;
    }
  }
}

/// Bending hardly depends on Poisson's ratio. Without smoothing, the pressure of linear tets resists it.
TEST(Cantilever, WithSmoothedVolumesANearlyIncompressibleBeamDoesNotLock) {
  for (const SolverKind solver : {SolverKind::kProjectiveDynamics, SolverKind::kFem}) {
    SimulatorConfig config;
    config.solver = solver;
    config.iterations = 20000;
    config.tolerance = 1e-9;
    const double compressible = cantileverRatio(3, config);
    EXPECT_NEAR(cantileverRatio(3, config, 0.495), compressible, 0.05);
    config.volume_smoothing = 0.7;
    EXPECT_LT(cantileverRatio(3, config, 0.495), 0.8 * compressible);
  }
}

}  // namespace
}  // namespace softbody
