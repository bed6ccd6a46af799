#include <gtest/gtest.h>

#include <stdexcept>

#include "cage/tet_mesher.h"
#include "fixtures/model_files.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

TEST(MeshInside, KeepsTheSurfaceAndFillsItsVolume) {
  const TriangleMesh torus = test::torus(0.1, 0.03, 24, 8);
  const TetMesh mesh = meshInside(torus, 0.02, true);
  EXPECT_EQ(boundaryTriangles(mesh.tets).rows(), torus.triangles.rows());
  const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
  EXPECT_GT(volumes.minCoeff(), 0.0);
  EXPECT_NEAR(volumes.sum(), enclosedVolume(torus.vertices, torus.triangles), 1e-12);
}

TEST(MeshInside, ASurfaceThatCrossesItselfIsRefusedAndNothingCrashes) {
  TriangleMesh torus = test::torus(0.1, 0.03, 24, 8);
  torus.vertices.row(3) << -0.3, 0.01, 0.02;
  EXPECT_THROW(meshInside(torus, 0.02, true), std::runtime_error);
}

}  // namespace
}  // namespace softbody
