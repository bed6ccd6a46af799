#include <gtest/gtest.h>

#include <map>
#include <random>
#include <stdexcept>
#include <utility>

#include "random_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

class TetGeometry : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random_{GetParam()};
  TetMesh mesh_ = shakenBlock(3, 2, 4, 0.02, 0.15, &random_);
};
INSTANTIATE_TEST_SUITE_P(Seeds, TetGeometry, testing::Range(0u, 10u));

TEST(TetVolumes, KnownSolids) {
  TetMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3;
  mesh.tets.resize(2, 4);
  mesh.tets << 0, 1, 2, 3, 0, 2, 1, 3;
  EXPECT_DOUBLE_EQ(tetVolumes(mesh.vertices, mesh.tets)[0], 1.0);
  EXPECT_DOUBLE_EQ(tetVolumes(mesh.vertices, mesh.tets)[1], -1.0);
  const TetMesh block = blockOfTets(2, 3, 4, 0.5);
  EXPECT_NEAR(tetVolumes(block.vertices, block.tets).sum(), 3.0, 1e-12);
}

TEST_P(TetGeometry, VolumesDoNotDependOnTheFrame) {
  const Eigen::VectorXd volumes = tetVolumes(mesh_.vertices, mesh_.tets);
  ASSERT_GT(volumes.minCoeff(), 0.0);
  const Eigen::Isometry3d T = randomMotion(&random_);
  const Points moved = (mesh_.vertices * T.linear().transpose()).rowwise() + T.translation().transpose();
  EXPECT_LT((tetVolumes(moved, mesh_.tets) - volumes).cwiseAbs().maxCoeff(),
            1e-12 * volumes.maxCoeff() + 1e-18);
}

TEST_P(TetGeometry, TheBoundaryIsClosedAndOutward) {
  const Triangles boundary = boundaryTriangles(mesh_.tets);
  EXPECT_EQ(boundary.rows(), 4 * (3 * 2 + 2 * 4 + 3 * 4));
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index f = 0; f < boundary.rows(); ++f) {
    for (int k = 0; k < 3; ++k) ++edges[{boundary(f, k), boundary(f, (k + 1) % 3)}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  // Divergence theorem: outward faces enclose what the tets hold.
  const double sum = tetVolumes(mesh_.vertices, mesh_.tets).sum();
  EXPECT_NEAR(enclosedVolume(mesh_.vertices, boundary), sum, 1e-12 * sum);
}

TEST_P(TetGeometry, ASurfaceIsClosedUntilATriangleIsMissingTurnedOrTwice) {
  const Triangles closed = boundaryTriangles(mesh_.tets);
  EXPECT_TRUE(isClosed(closed));
  EXPECT_TRUE(isClosed(closed.rowwise().reverse()));
  EXPECT_TRUE(isClosed(closed.replicate(2, 1)));
  EXPECT_TRUE(isClosed(Triangles(0, 3)));
  const auto f = static_cast<Eigen::Index>(random_() % static_cast<unsigned>(closed.rows()));
  Triangles missing = closed, turned = closed, twice(closed.rows() + 1, 3);
  missing.row(f) = missing.row(missing.rows() - 1).eval();
  turned.row(f).reverseInPlace();
  twice << closed, closed.row(f);
  EXPECT_FALSE(isClosed(missing.topRows(missing.rows() - 1)));
  EXPECT_FALSE(isClosed(turned));
  EXPECT_FALSE(isClosed(twice));
}

TEST_P(TetGeometry, BarycentricCoordinatesReproduceThePoint) {
  for (int trial = 0; trial < 100; ++trial) {
    const int t = static_cast<int>(random_() % mesh_.tets.rows());
    const Eigen::Vector3d point = randomPoint(-0.1, 0.2, &random_);
    const Eigen::Vector4d weights = barycentricCoordinates(point, mesh_.vertices, mesh_.tets.row(t));
    EXPECT_NEAR(weights.sum(), 1.0, 1e-12);
    EXPECT_LT((positionOf({t, weights}, mesh_.vertices, mesh_.tets) - point).norm(), 1e-12);
  }
  const Eigen::Vector4i flat(mesh_.tets(0, 0), mesh_.tets(0, 1), mesh_.tets(0, 2), mesh_.tets(0, 2));
  EXPECT_THROW(barycentricCoordinates({0, 0, 0}, mesh_.vertices, flat), std::invalid_argument);
}

TEST_P(TetGeometry, NormalsAreUnitAndPointAwayFromAConvexBody) {
  const TetMesh block = blockOfTets(2, 2, 2, 0.1);
  Points vertices = block.vertices;
  vertices.conservativeResize(vertices.rows() + 1, 3);
  vertices.bottomRows(1).setConstant(9.0);  // no triangle touches it
  const Points normals = vertexNormals(vertices, boundaryTriangles(block.tets));
  for (Eigen::Index v = 0; v < block.vertices.rows(); ++v) {
    const Eigen::Vector3d outward = block.vertices.row(v).transpose() - Eigen::Vector3d::Constant(0.1);
    if (outward.norm() < 1e-9) continue;  // the block's inner vertex
    EXPECT_NEAR(normals.row(v).norm(), 1.0, 1e-12);
    EXPECT_GT(normals.row(v).dot(outward), 0.0);
  }
  EXPECT_EQ(normals.bottomRows(1).norm(), 0.0);
}

TEST_P(TetGeometry, PiecesAreCountedInOrderOfAppearance) {
  const TetMesh other = blockOfTets(1, 1, 1, 1.0);
  const Eigen::Index first = mesh_.tets.rows(), offset = mesh_.vertices.rows();
  Tets both(first + other.tets.rows(), 4);
  both << mesh_.tets, (other.tets.array() + static_cast<int>(offset)).matrix();
  const int vertex_count = static_cast<int>(offset + other.vertices.rows());
  const std::vector<std::uint32_t> bodies = tetPieces(both, vertex_count);
  for (Eigen::Index t = 0; t < both.rows(); ++t) EXPECT_EQ(bodies[t], t < first ? 0u : 1u);
  const Triangles surface = boundaryTriangles(both);
  const std::vector<std::uint32_t> pieces = trianglePieces(surface, vertex_count);
  for (Eigen::Index f = 0; f < surface.rows(); ++f) EXPECT_EQ(pieces[f], surface(f, 0) < offset ? 0u : 1u);
}

TEST_P(TetGeometry, EdgeLengthScalesWithTheMesh) {
  const double length = meanEdgeLength(mesh_.vertices, mesh_.tets);
  EXPECT_NEAR(meanEdgeLength(3.0 * mesh_.vertices, mesh_.tets), 3.0 * length, 1e-12);
  EXPECT_EQ(meanEdgeLength(Points(0, 3), Tets(0, 4)), 0.0);
}

TEST(CornerWeights, APointOfATriangleIsTheWeightedSumOfItsCorners) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Matrix3d corners = Eigen::Matrix3d::NullaryExpr([&] { return uniform(random); });
    Eigen::Vector3d weights = Eigen::Vector3d::NullaryExpr([&] { return uniform(random); });
    weights /= weights.sum();
    EXPECT_TRUE(cornerWeights(corners * weights, corners.col(0), corners.col(1), corners.col(2))
                    .isApprox(weights, 1e-6));
  }
  const Eigen::Vector3d point = Eigen::Vector3d::Ones();
  EXPECT_TRUE(cornerWeights(point, point, point, point).isApproxToConstant(1.0 / 3.0));
}

}  // namespace
}  // namespace softbody
