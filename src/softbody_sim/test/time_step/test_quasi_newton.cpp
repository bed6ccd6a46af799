#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "elasticity/corotated_elasticity.h"
#include "fixtures/test_meshes.h"
#include "linear_solvers/positive_definite_solver.h"
#include "time_step/force_balance.h"
#include "time_step/incremental_potential.h"
#include "time_step/quasi_newton.h"

namespace softbody {
namespace {

using testing::randomPoints;

/// The energy of a body, with its metric.
struct Problem {
  TetTopology topology = testing::boxTopology({4, 3, 2}, {0.08, 0.06, 0.04});
  Eigen::Index count = topology.rest_vertices.rows();
  CorotatedElasticity elasticity{topology.rest_vertices, topology.tets, lameParameters(2.0e4, 0.3)};
  IncrementalPotential potential{
      Eigen::VectorXd::Constant(count, 0.5), topology.rest_vertices, Points::Zero(count, 3), {}};
  TargetEnergy& targets = potential.targets;
  TetMatrix matrix{topology.tets, count};
  QuasiNewton<Points> minimizer{count};

  static QuasiNewton<Points>::Metric solving(PositiveDefiniteSolver& solver) {
    return [&solver](const Points& B, Points* X) { solver.solve(B, X); };
  }
  StepReport minimize(int iterations, double tolerance, Points* x) {
    matrix.values().setZero();
    matrix.addToDiagonal(potential.inertia);
    elasticity.addMetric(&matrix);
    targets.addMetric(&matrix);
    PositiveDefiniteSolver metric(matrix.lower());
    metric.factorize(matrix.lower());
    return minimizer.minimize([this](const Points& y, Points* g) { return evaluate(y, g); }, solving(metric),
                              {iterations, tolerance}, x);
  }
  double energyAt(const Points& x) const {
    Points unused(count, 3);
    return evaluate(x, &unused).energy_j;
  }
  StepEnergy evaluate(const Points& x, Points* gradient) const {
    const auto add = [&](Points* sum) { return elasticity.addTo(x, sum); };
    return ForceBalance<Points>().complete(potential, potential.evaluate(x, gradient), add, gradient);
  }
};

TEST(PositiveDefiniteSolver, InvertsItsMatrix) {
  std::mt19937 random(1);
  const TetTopology topology = testing::boxTopology({3, 3, 3}, {0.1, 0.1, 0.1});
  const Eigen::Index n = topology.rest_vertices.rows();
  TetMatrix matrix(topology.tets, n);
  CorotatedElasticity(topology.rest_vertices, topology.tets, {1.0, 1.0}).addMetric(&matrix);
  PositiveDefiniteSolver solver(matrix.lower());
  for (double diagonal : {0.1, 3.0}) {  // the second factorisation reuses the analysis of the first
    matrix.addToDiagonal(Eigen::VectorXd::Constant(n, diagonal));
    solver.factorize(matrix.lower());
    const Points B = randomPoints(n, 1.0, &random);
    Points X;
    solver.solve(B, &X);
    const Points product = matrix.lower().selfadjointView<Eigen::Lower>() * X;
    EXPECT_LT((product - B).norm(), 1e-12 * B.norm());
  }
  matrix.addToDiagonal(Eigen::VectorXd::Constant(n, -100.0));
  EXPECT_THROW(solver.factorize(matrix.lower()), std::runtime_error);
}

TEST(QuasiNewton, SolvesAQuadraticInOneIteration) {
  std::mt19937 random(2);
  Problem problem;
  PositiveDefiniteSolver metric([&] {
    problem.matrix.addToDiagonal(Eigen::VectorXd::Constant(problem.count, 2.0));
    return problem.matrix.lower();
  }());
  metric.factorize(problem.matrix.lower());
  const Points goal = randomPoints(problem.count, 1.0, &random);
  Points x = Points::Zero(problem.count, 3);
  const StepReport report = problem.minimizer.minimize(
      [&goal](const Points& y, Points* gradient) {
        *gradient = 2.0 * (y - goal);
        return (y - goal).squaredNorm();
      },
      Problem::solving(metric), {1, 1e-9}, &x);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_LT((x - goal).norm(), 1e-12);
}

TEST(QuasiNewton, NeverRaisesTheEnergy) {
  std::mt19937 random(3);
  for (double disorder : {0.001, 0.02, 0.2}) {
    for (bool with_normals : {false, true}) {
      Problem problem;
      std::vector<Target> targets = testing::vertexTargets(
          problem.topology, transformed(problem.topology.rest_vertices, testing::somePose()));
      for (std::size_t i = 0; with_normals && i < targets.size(); ++i) {
        targets[i].normal = randomPoints(1, 1.0, &random).transpose().normalized();
      }
      problem.targets.set(targets, problem.topology.tets, 300.0);
      const Points start = problem.topology.rest_vertices + randomPoints(problem.count, disorder, &random);
      double previous = problem.energyAt(start);
      for (int iterations = 1; iterations <= 40; ++iterations) {
        Points x = start;
        problem.minimize(iterations, 0.0, &x);
        const double energy = problem.energyAt(x);
        ASSERT_TRUE(std::isfinite(energy));
        EXPECT_LE(energy, previous * (1.0 + 1e-13)) << "iteration " << iterations;
        previous = energy;
      }
    }
  }
}

/// A tilted washboard potential for the first vertex: it falls without end, and half of its curvature is
/// negative.
double washboard(const Points& x, Points* gradient) {
  Eigen::Matrix3d waves;
  waves << 1.0, 0.7, -0.2, 0.3, -1.5, 0.4, -0.6, 0.5, 2.1;
  const Eigen::Vector3d slope(1.0, 0.8, 0.6), p = x.row(0);
  const Eigen::Array3d phases = waves * p;
  gradient->setZero();
  gradient->row(0) = slope - 0.25 * waves.transpose() * phases.sin().matrix();
  return slope.dot(p) + 0.25 * phases.cos().sum();
}

TEST(QuasiNewton, FallsInEveryIterationAcrossNegativeCurvature) {
  std::mt19937 random(5);
  Problem problem;
  problem.matrix.addToDiagonal(Eigen::VectorXd::Constant(problem.count, 1.0));
  PositiveDefiniteSolver metric(problem.matrix.lower());
  metric.factorize(problem.matrix.lower());
  Points unused(problem.count, 3);
  for (int start = 0; start < 1000; ++start) {
    const Points x0 = randomPoints(problem.count, 10.0, &random);
    double previous = washboard(x0, &unused);
    // Far down, the waves are lost in rounding.
    for (int iterations = 1; previous > -1e8 && iterations <= 50; ++iterations) {
      Points x = x0;
      problem.minimizer.minimize(washboard, Problem::solving(metric), {iterations, 0.0}, &x);
      const double energy = washboard(x, &unused);
      ASSERT_LT(energy, previous) << "start " << start << ", iteration " << iterations;
      previous = energy;
    }
  }
}

TEST(QuasiNewton, ReportsConvergenceHonestly) {
  Problem problem;
  const Points goal = transformed(problem.topology.rest_vertices, testing::somePose());
  problem.targets.set(testing::vertexTargets(problem.topology, goal), problem.topology.tets, 300.0);
  Points x = problem.topology.rest_vertices;
  EXPECT_FALSE(problem.minimize(1, 1e-5, &x).converged);
  const StepReport report = problem.minimize(500, 1e-5, &x);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.iterations, 200);
  Points gradient(problem.count, 3);
  const StepEnergy energy = problem.evaluate(x, &gradient);
  EXPECT_EQ(report.external_n, energy.external_n);
  EXPECT_EQ(report.residual_n, gradient.cwiseAbs().sum());
  EXPECT_LE(report.residual_n, 1e-5 * report.external_n);
}

/// Quasi-static steps: each starts without velocity at the end of the last one.
void expectReturnsToRest(Points x, const char* what) {
  Problem problem;
  for (int step = 0; step < 60; ++step) {
    problem.potential.prediction = x;
    problem.minimize(50, 1e-7, &x);
    ASSERT_TRUE(x.allFinite()) << what;
  }
  Points unused = Points::Zero(problem.count, 3);
  EXPECT_LT(problem.elasticity.addTo(x, &unused), 1e-9) << what;
  EXPECT_GT(tetVolumes(x, problem.topology.tets).minCoeff(), 0.0) << what;
  const Eigen::Isometry3d pose = fitRigid(problem.topology.rest_vertices, x);
  EXPECT_LT((x - transformed(problem.topology.rest_vertices, pose)).rowwise().norm().maxCoeff(), 1e-4)
      << what;
}

TEST(QuasiNewton, ReturnsAnyShapeToRest) {
  std::mt19937 random(4);
  const Points rest = Problem().topology.rest_vertices;
  const Eigen::RowVector3d center = rest.colwise().mean();
  const auto scaled = [&](double x, double y, double z) {
    return Points((rest.rowwise() - center) * Eigen::Vector3d(x, y, z).asDiagonal());
  };
  expectReturnsToRest(scaled(1, 1, 1), "rest");
  expectReturnsToRest(scaled(1, 1, 0), "crushed flat");
  expectReturnsToRest(scaled(1, 0, 0), "crushed to a line");
  expectReturnsToRest(scaled(0, 0, 0), "crushed to a point");
  expectReturnsToRest(scaled(1, 1, -1), "mirrored");
  expectReturnsToRest(scaled(-1, -1, -1), "inside out");
  expectReturnsToRest(scaled(20, 20, 20), "blown up");
  for (int k = 0; k < 5; ++k) expectReturnsToRest(randomPoints(rest.rows(), 0.05, &random), "random");
}

}  // namespace
}  // namespace softbody
