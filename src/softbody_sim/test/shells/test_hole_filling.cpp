#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/model_files.h"
#include "shells/hole_filling.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// A row of triangles, and the cap of a tube: a bent rim and a flat one.
TEST(FillHoles, ClosesTheMeshWithTrianglesBetweenItsVerticesAndTheRimsTexture) {
  const TriangleMesh torus = test::torus(0.1, 0.03, 60, 24);
  WeldedSurface open{torus, Points(3 * torus.triangles.rows(), 3), {}};
  open.vertex_parents.resize(static_cast<std::size_t>(torus.vertices.rows()));
  for (Eigen::Index corner = 0; corner < open.texture_coordinates.rows(); ++corner)
    open.texture_coordinates.row(corner) = torus.vertices.row(torus.triangles(corner / 3, corner % 3));
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 10; f < torus.triangles.rows(); ++f)
    if (f < 480 || f >= 720) kept.push_back(f);  // five rings of the tube
  keepTriangles(kept, &open);
  const Eigen::Index vertices = open.mesh.vertices.rows();
  const FilledHoles filled = fillHoles(&open);
  EXPECT_EQ(filled.count, 3);
  EXPECT_NEAR(filled.widest, 0.06 * std::sqrt(2.0), 0.01);
  EXPECT_EQ(open.mesh.vertices.rows(), vertices);
  EXPECT_TRUE(examineEdges(open.mesh.triangles).closed());
  EXPECT_EQ(examineEdges(open.mesh.triangles).inconsistent, 0);
  EXPECT_NEAR(enclosedVolume(open.mesh.vertices, open.mesh.triangles) /
                  enclosedVolume(torus.vertices, torus.triangles),
              11.0 / 12.0, 0.01);
  for (Eigen::Index corner = 0; corner < open.texture_coordinates.rows(); ++corner)
    EXPECT_EQ(open.texture_coordinates.row(corner),
              open.mesh.vertices.row(open.mesh.triangles(corner / 3, corner % 3)));
  EXPECT_EQ(fillHoles(&open).count, 0);
}

}  // namespace
}  // namespace softbody
