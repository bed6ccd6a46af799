#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fixtures/test_meshes.h"
#include "linear_solvers/hessian_factor.h"
#include "tets/block_tet_matrix.h"

namespace softbody {
namespace {

/// A positive definite matrix over the tets, with random blocks.
BlockTetMatrix randomMatrix(const TetTopology& body, std::mt19937* random) {
  std::vector<Eigen::VectorXi> groups;
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t) groups.emplace_back(body.tets.row(t).transpose());
  BlockTetMatrix matrix(groups, body.rest_vertices.rows());
  for (std::size_t t = 0; t < groups.size(); ++t) {
    const Eigen::MatrixXd half = testing::randomPoints(48, 1.0, random).reshaped(12, 12);
    matrix.addToGroup(t, half * half.transpose());
  }
  matrix.addToDiagonal(Eigen::VectorXd::Constant(body.rest_vertices.rows(), 1.0));
  return matrix;
}

Rows<double> rowsOf(const Points& points) {
  Rows<double> rows = Rows<double>::Zero(paddedRows(points.rows()), 4);
  rows.topLeftCorner(points.rows(), 3) = points;
  return rows;
}

void expectSolves(const TetTopology& body, HessianFactor* factor, std::mt19937* random) {
  const BlockTetMatrix matrix = randomMatrix(body, random);
  ASSERT_TRUE(factor->factorize(matrix.lower()));
  const Eigen::Index count = body.rest_vertices.rows();
  const Points truth = testing::randomPoints(count, 1.0, random);
  const Eigen::MatrixXd dense = Eigen::MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd forces = dense * truth.reshaped<Eigen::RowMajor>();
  Rows<double> x = rowsOf(truth);
  factor->solve(rowsOf(forces.reshaped<Eigen::RowMajor>(count, 3)), &x);
  EXPECT_LT((x.topLeftCorner(count, 3) - truth).norm(), 1e-3 * truth.norm());
  EXPECT_EQ(x.col(3).norm(), 0.0);
}

TEST(HessianFactor, SolvesAsADenseMatrixDoes) {
  std::mt19937 random(3);
  for (const TetTopology& body : {testing::boxTopology({1, 1, 1}, {0.1, 0.1, 0.1}), testing::sponge()}) {
    HessianFactor factor(randomMatrix(body, &random).lower());
    for (int k = 0; k < 3; ++k) expectSolves(body, &factor, &random);
  }
}

TEST(HessianFactor, SaysThatAMatrixIsNotPositiveDefiniteAndGoesOn) {
  std::mt19937 random(4);
  const TetTopology body = testing::boxTopology({2, 1, 1}, {0.2, 0.1, 0.1});
  HessianFactor factor(randomMatrix(body, &random).lower());
  BlockTetMatrix indefinite = randomMatrix(body, &random);
  indefinite.addToDiagonal(Eigen::VectorXd::Constant(body.rest_vertices.rows(), -1e3));
  EXPECT_FALSE(factor.factorize(indefinite.lower()));
  expectSolves(body, &factor, &random);
}

}  // namespace
}  // namespace softbody
