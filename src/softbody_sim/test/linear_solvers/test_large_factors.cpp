#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "elasticity/corotated_elasticity.h"
#include "fixtures/test_meshes.h"
#include "linear_solvers/global_step_solver.h"

namespace softbody {
namespace {

using testing::randomPoints;

/// The metric of a box, large enough for supernodes and METIS, or for half precision alone.
struct Box {
  explicit Box(const Eigen::Vector3i& cells) : topology(testing::boxTopology(cells, {0.2, 0.1, 0.1})) {
    CorotatedElasticity(topology.rest_vertices, topology.tets, {8000.0, 5000.0}).addMetric(&matrix);
  }
  void addToDiagonal(double value) { matrix.addToDiagonal(Eigen::VectorXd::Constant(count, value)); }
  Points times(const Points& X) const { return matrix.lower().selfadjointView<Eigen::Lower>() * X; }

  TetTopology topology;
  Eigen::Index count = topology.rest_vertices.rows();
  TetMatrix matrix{topology.tets, count};
};

void expectInverse(const Box& box, PositiveDefiniteSolver* solver, std::mt19937* random) {
  const Points B = randomPoints(box.count, 1.0, random);
  Points X;
  solver->solve(B, &X);
  EXPECT_LT((box.times(X) - B).norm(), 1e-10 * B.norm());
}

TEST(LargeFactors, InvertTheMatrixBeforeAndAfterUpdates) {
  std::mt19937 random(1);
  Box box({16, 16, 16});
  box.addToDiagonal(3.0);
  PositiveDefiniteSolver solver(box.matrix.lower());
  for (int factorization = 0; factorization < 2; ++factorization) {
    solver.factorize(box.matrix.lower());
    expectInverse(box, &solver, &random);
    for (const bool add : {true, true, false}) {
      const int tet = static_cast<int>(random() % static_cast<unsigned>(box.topology.tets.rows()));
      const TetVector change{box.topology.tets.row(tet).transpose(), {3.0, 1.0, 0.0, 2.0}};
      const double sign = add ? 1.0 : -0.01;
      box.matrix.addToTet(tet, sign * change.values * change.values.transpose());
      const std::vector<TetVector> changes{{change.vertices, std::sqrt(std::abs(sign)) * change.values}};
      solver.update(add ? changes : std::vector<TetVector>(), add ? std::vector<TetVector>() : changes);
      expectInverse(box, &solver, &random);
    }
  }
  box.addToDiagonal(-1e6);
  EXPECT_THROW(solver.factorize(box.matrix.lower()), std::runtime_error);
}

/// Share of the solution of A X = B by which the solver's factor in single or half precision errs.
double errorOf(const Box& box, GlobalStepSolver<float>* solver, const Points& X) {
  Rows<float> B = Rows<float>::Zero(paddedRows(box.count), 4), found = B;
  B.topLeftCorner(box.count, 3) = box.times(X).cast<float>();
  solver->solve(B, &found);
  EXPECT_EQ(found.col(3).norm(), 0.0f);
  return (found.topLeftCorner(box.count, 3).cast<double>() - X).norm() / X.norm();
}

TEST(LargeFactors, AreMetricsInHalfPrecision) {
  std::mt19937 random(2);
  for (const int cells : {9, 16}) {
    Box box({cells, cells, cells});
    box.addToDiagonal(20.0);
    GlobalStepSolver<float> solver(box.matrix.lower(), Simd::kAuto);
    solver.factorize(box.matrix.lower());
    EXPECT_LT(errorOf(box, &solver, randomPoints(box.count, 1.0, &random)), 0.01);
    EXPECT_LT(errorOf(box, &solver, Points::Ones(box.count, 3)), 0.1);
  }
}

/// Nothing but a tiny inertia holds the body: half precision would not know its softest motion.
TEST(LargeFactors, AreMoreExactWhereHalfPrecisionDoesNotSuffice) {
  Box box({9, 9, 9});
  box.addToDiagonal(1e-3);
  GlobalStepSolver<float> solver(box.matrix.lower(), Simd::kAuto);
  solver.factorize(box.matrix.lower());
  EXPECT_LT(errorOf(box, &solver, Points::Ones(box.count, 3)), 0.5);
}

TEST(LargeFactors, SolveForPositionsInDoublePrecisionToo) {
  std::mt19937 random(3);
  Box box({9, 9, 9});
  box.addToDiagonal(20.0);
  GlobalStepSolver<float> solver(box.matrix.lower(), Simd::kAuto);
  solver.factorize(box.matrix.lower());
  Rows<double> B = Rows<double>::Zero(paddedRows(box.count), 4), X = B;
  B.topLeftCorner(box.count, 3) = randomPoints(box.count, 1.0, &random);
  Rows<float> of_float = Rows<float>::Zero(B.rows(), 4);
  solver.solveSparse(B, &X);
  solver.solve(B.cast<float>(), &of_float);
  EXPECT_LT((X.cast<float>() - of_float).norm(), 1e-5f * of_float.norm());
}

}  // namespace
}  // namespace softbody
