#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "elasticity/corotated_elasticity.h"
#include "fixtures/test_meshes.h"
#include "linear_solvers/global_step_solver.h"
#include "tets/tet_matrix.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::randomPoints;

/// Two bodies that share no vertex.
TetTopology twoBoxes(const TetTopology& a, const TetTopology& b) {
  TetTopology both;
  const int shift = static_cast<int>(a.rest_vertices.rows());
  both.rest_vertices.resize(shift + b.rest_vertices.rows(), 3);
  both.rest_vertices << a.rest_vertices, b.rest_vertices;
  both.tets.resize(a.tets.rows() + b.tets.rows(), 4);
  both.tets << a.tets, (b.tets.array() + shift).matrix();
  return both;
}

std::vector<TetTopology> bodies() {
  TetTopology tet;
  tet.rest_vertices.resize(4, 3);
  tet.rest_vertices << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1;
  tet.tets.resize(1, 4);
  tet.tets << 0, 1, 2, 3;
  const TetTopology cube = boxTopology({3, 3, 3}, {0.1, 0.1, 0.1});
  return {tet, testing::sponge(), cube, twoBoxes(cube, testing::sponge()), twoBoxes(tet, tet)};
}

TEST(Dissection, DecouplesThePartsAndKeepsEveryRow) {
  for (const TetTopology& body : bodies()) {
    const auto count = static_cast<int>(body.rest_vertices.rows());
    const TetMatrix matrix(body.tets, count);
    const Dissection found = dissect(matrix.lower());
    EXPECT_EQ(found.first + found.separator + found.second, count);
    std::vector<int> sorted = found.order, all(static_cast<std::size_t>(count));
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(sorted, all);
    std::vector<int> side(static_cast<std::size_t>(count), 0);
    for (int k = 0; k < found.first; ++k) side[static_cast<std::size_t>(found.order[k])] = -1;
    for (int k = count - found.second; k < count; ++k) side[static_cast<std::size_t>(found.order[k])] = 1;
    for (Eigen::Index t = 0; t < body.tets.rows(); ++t) {
      int sides[4];
      for (int k = 0; k < 4; ++k) sides[k] = side[static_cast<std::size_t>(body.tets(t, k))];
      EXPECT_LT(*std::max_element(sides, sides + 4) - *std::min_element(sides, sides + 4), 2) << "tet " << t;
    }
  }
}

TEST(Dissection, HalvesALongBodyAndNeedsNoSeparatorForTwoBodies) {
  const TetTopology bar = boxTopology({20, 2, 2}, {0.4, 0.04, 0.04});
  const Dissection halves = dissect(TetMatrix(bar.tets, bar.rest_vertices.rows()).lower());
  EXPECT_LE(halves.separator, 12);
  EXPECT_LT(std::max(halves.first, halves.second), 0.6 * static_cast<double>(bar.rest_vertices.rows()));

  const TetTopology two = twoBoxes(bar, bar);
  const Dissection parts = dissect(TetMatrix(two.tets, two.rest_vertices.rows()).lower());
  EXPECT_EQ(parts.separator, 0);
  EXPECT_EQ(parts.first, parts.second);
}

TEST(SplitInverse, SolvesLikeTheSparseFactorForEveryBody) {
  std::mt19937 random(3);
  for (const TetTopology& body : bodies()) {
    const Eigen::Index count = body.rest_vertices.rows();
    TetMatrix matrix(body.tets, count);
    CorotatedElasticity(body.rest_vertices, body.tets, {8000.0, 5000.0}).addMetric(&matrix);
    matrix.addToDiagonal(Eigen::VectorXd::Constant(count, 0.01));  // nearly free to move as a whole
    GlobalStepSolver<double> solver(matrix.lower(), Simd::kAuto);
    solver.factorize(matrix.lower());
    Rows<double> B = Rows<double>::Zero(paddedRows(count), 4), sparse = B, dense = B;
    B.topLeftCorner(count, 3) = randomPoints(count, 1.0, &random);
    solver.solve(B, &sparse);
    for (Eigen::Index k = 0; k < count; ++k) solver.solve(B, &dense);
    EXPECT_LT((sparse - dense).norm(), 1e-9 * sparse.norm());
    EXPECT_NE(sparse, dense) << "still the sparse factor";
  }
}

}  // namespace
}  // namespace softbody
