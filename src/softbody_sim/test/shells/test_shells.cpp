#include <gtest/gtest.h>

#include "fixtures/box_meshes.h"
#include "fixtures/model_files.h"
#include "shells/shell_list.h"
#include "shells/shell_union.h"
#include "shells/simplification.h"
#include "shells/surface_transfer.h"

namespace softbody {
namespace {

using test::boxMesh;
using test::together;

TEST(Shells, BoxesThatTouchInAnEdgeAreTwoAndAPlaneIsASheet) {
  const TriangleMesh touching = together(
      {boxMesh({1, 1, 1}, {0, 0, 0}, {1, 1, 1}),
       boxMesh({1, 1, 1}, {1, 1, 0}, {1, 1, 1}),
       {(Points(3, 3) << 5, 0, 0, 6, 0, 0, 5, 1, 0).finished(), (Triangles(1, 3) << 0, 1, 2).finished()}});
  Warnings ignored;
  const WeldedSurface welded = repairSurface({touching, {}}, "boxes", &ignored);
  ASSERT_EQ(welded.mesh.vertices.rows(), 8 + 8 - 2 + 3);
  const std::vector<Shell> shells = shellsOf(welded.mesh);
  ASSERT_EQ(shells.size(), 3U);
  EXPECT_NEAR(shells[0].volume, 1.0, 1e-12);
  EXPECT_NEAR(shells[0].area, 6.0, 1e-12);
  EXPECT_NEAR(shells[1].box.center().x(), 1.0, 1e-12);
  EXPECT_FALSE(shells[1].isSheet());
  EXPECT_TRUE(shells[2].isSheet());
}

TEST(UnionOf, OfAMeshThatCrossesItselfThereIsNone) {
  TriangleMesh torus = test::torus(0.1, 0.03, 24, 8);
  const TriangleMesh box = boxMesh({0.1, 0.1, 0.01}, {0.1, 0, 0});
  EXPECT_TRUE(unionOf(torus, box));
  torus.vertices.row(3) << -0.3, 0.01, 0.02;
  EXPECT_FALSE(unionOf(torus, box));
}

TEST(Simplified, KeepsVolumeAndClosedness) {
  const TriangleMesh torus = test::torus(0.1, 0.03, 120, 48);
  const TriangleMesh simple = simplified(torus, 1000);
  EXPECT_NEAR(static_cast<double>(simple.triangles.rows()), 1000.0, 10.0);
  EXPECT_TRUE(isClosed(simple.triangles));
  EXPECT_NEAR(
      enclosedVolume(simple.vertices, simple.triangles) / enclosedVolume(torus.vertices, torus.triangles),
      1.0, 0.005);
}

/// The texture is the position, so it must be so after the transfer.
TEST(Transferred, TextureAndParentsFollowThePlaces) {
  WeldedSurface from{boxMesh({0.2, 0.1, 0.04}), {}, {}};
  from.texture_coordinates.resize(3 * from.mesh.triangles.rows(), 3);
  for (Eigen::Index corner = 0; corner < from.texture_coordinates.rows(); ++corner)
    from.texture_coordinates.row(corner) =
        from.mesh.vertices.row(from.mesh.triangles(corner / 3, corner % 3));
  for (int v = 0; v < from.mesh.vertices.rows(); ++v) from.vertex_parents.push_back(10 + v);
  const TriangleMesh finer = boxMesh({0.2, 0.1, 0.04}, {0, 0, 0}, {10, 8, 6});
  const WeldedSurface to = transferred(from, finer);
  ASSERT_EQ(to.mesh.vertices.rows(), finer.vertices.rows());
  EXPECT_NEAR(enclosedVolume(to.mesh.vertices, to.mesh.triangles), 8e-4, 1e-12);
  for (Eigen::Index v = 0; v < to.mesh.vertices.rows(); ++v)
    EXPECT_EQ(to.vertex_parents[static_cast<std::size_t>(v)], v < from.mesh.vertices.rows() ? 10 + v : -1);
  for (Eigen::Index corner = 0; corner < to.texture_coordinates.rows(); ++corner)
    EXPECT_TRUE(to.texture_coordinates.row(corner).isApprox(
        to.mesh.vertices.row(to.mesh.triangles(corner / 3, corner % 3)), 1e-6));
}

}  // namespace
}  // namespace softbody
