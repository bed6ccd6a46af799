#include <gtest/gtest.h>

#include "fixtures/synthetic_scene.h"
#include "registration/box_mesh.h"
#include "registration/coarse_mesh.h"

namespace softbody {
namespace {

TEST(ClusteredMesh, KeepsTheShapeWithinACell) {
  const TriangleMesh coarse = clustered(kMesh, 0.03, 0.25);
  EXPECT_LT(coarse.vertices.rows(), kMesh.vertices.rows());
  EXPECT_GT(coarse.triangles.rows(), 20);
  for (Eigen::Index v = 0; v < coarse.vertices.rows(); ++v)
    EXPECT_LT((kMesh.vertices.rowwise() - coarse.vertices.row(v)).rowwise().norm().minCoeff(), 0.03);
}

TEST(SearchMeshes, OfADenseBodyAreSmallerWithItsShape) {
  const BoxBody box = makeBox(160, 80, 32);
  const SearchMeshes meshes = makeSearchMeshes({box.surface.rest_vertices, box.surface.triangles});
  EXPECT_LT(2 * meshes.fine.triangles.rows(), meshes.full.triangles.rows());
  EXPECT_LT(2 * meshes.coarse.triangles.rows(), meshes.fine.triangles.rows());
  const auto sidesOf = [](const TriangleMesh& mesh) {
    return Eigen::RowVector3d(mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff());
  };
  EXPECT_LT((sidesOf(meshes.fine) - sidesOf(meshes.full)).norm(), 0.01 * meshes.diameter_m);
}

TEST(SearchMeshes, OfACoarseBodyAreTheBody) {
  const SearchMeshes meshes = makeSearchMeshes(kMesh);
  EXPECT_EQ(meshes.fine.vertices, meshes.full.vertices);
  EXPECT_EQ(meshes.fine.triangles, meshes.full.triangles);
}

TEST(ClusteredMesh, KeepsAThreadThinnerThanACell) {
  TriangleMesh thread = kMesh;
  thread.vertices.rightCols(2) *= 0.05;
  thread.vertices.rightCols(2).array() += 0.01;  // in a single row of cells
  const TriangleMesh coarse = clustered(thread, 0.03, 0.25);
  EXPECT_GT(coarse.triangles.rows(), 20);
  EXPECT_LT(coarse.vertices.col(0).minCoeff(), -0.08);
  EXPECT_GT(coarse.vertices.col(0).maxCoeff(), 0.08);
}

}  // namespace
}  // namespace softbody
