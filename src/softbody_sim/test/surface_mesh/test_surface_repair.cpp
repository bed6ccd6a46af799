#include <test_support/gtest.h>

#include <numeric>
#include <random>

#include "fixtures/model_files.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/object/object_description.h"
#include "softbody_sim/object/visual_mesh.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

/// Gives every triangle its own three vertices, as in STL.
SurfaceFile exploded(const TriangleMesh& mesh) {
  SurfaceFile file;
  file.mesh.vertices.resize(3 * mesh.triangles.rows(), 3);
  file.mesh.triangles.resize(mesh.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      file.mesh.vertices.row(3 * f + k) = mesh.vertices.row(mesh.triangles(f, k));
      file.mesh.triangles(f, k) = static_cast<int>(3 * f) + k;
    }
  }
  return file;
}

TEST(RepairSurface, LeavesACleanMeshAlone) {
  const TriangleMesh mesh = test::torus(1.0, 0.3, 24, 12);
  Warnings warnings;
  const WeldedSurface repaired = repairSurface({mesh, {}}, "torus", &warnings);
  EXPECT_EQ(repaired.mesh.vertices, mesh.vertices);
  EXPECT_EQ(repaired.mesh.triangles, mesh.triangles);
  std::vector<int> identity(static_cast<std::size_t>(mesh.vertices.rows()));
  std::iota(identity.begin(), identity.end(), 0);
  EXPECT_EQ(repaired.vertex_parents, identity);
  EXPECT_TRUE(warnings.empty());
}

TEST(RepairSurface, WeldsNoisyCornersAndParentsAreTheFirstAtTheirPlace) {
  const TriangleMesh mesh = test::torus(1.0, 0.3, 24, 12);
  SurfaceFile file = exploded(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1e-8, 1e-8);
  for (double& x : file.mesh.vertices.reshaped()) x += noise(random);
  Warnings warnings;
  const WeldedSurface repaired = repairSurface(file, "torus", &warnings);
  EXPECT_EQ(repaired.mesh.vertices.rows(), mesh.vertices.rows());
  EXPECT_TRUE(examineEdges(repaired.mesh.triangles).closed());
  for (std::size_t v = 0; v < repaired.vertex_parents.size(); ++v) {
    EXPECT_EQ(repaired.mesh.vertices.row(static_cast<Eigen::Index>(v)),
              file.mesh.vertices.row(repaired.vertex_parents[v]));
    EXPECT_TRUE(v == 0 || repaired.vertex_parents[v - 1] < repaired.vertex_parents[v]);
  }
}

/// As far as rounding took the corners apart, and only then.
TEST(RepairSurface, WeldsFurtherIfThatClosesTheMesh) {
  SurfaceFile file = exploded(test::torus(1.0, 0.3, 24, 12));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1e-5, 1e-5);
  for (double& x : file.mesh.vertices.reshaped()) x += noise(random);
  Warnings warnings;
  EXPECT_TRUE(examineEdges(repairSurface(file, "torus", &warnings).mesh.triangles).closed());
  TriangleMesh close = test::torus(1.0, 0.3, 24, 12);
  close.vertices.row(1) = close.vertices.row(0) + Eigen::RowVector3d(1e-5, 0.0, 0.0);
  EXPECT_EQ(repairSurface({close, {}}, "torus", &warnings).mesh.vertices.rows(), close.vertices.rows());
}

TEST(RepairSurface, MakesRandomlyTurnedTrianglesAgreeWithTheirTexture) {
  const TriangleMesh mesh = test::torus(1.0, 0.3, 24, 12);
  SurfaceFile file{mesh, Points(3 * mesh.triangles.rows(), 3)};
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      file.texture_coordinates.row(3 * f + k) = mesh.vertices.row(mesh.triangles(f, k));
  }
  std::mt19937 random(2);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    if (random() % 2 == 0) continue;
    std::swap(file.mesh.triangles(f, 0), file.mesh.triangles(f, 1));
    file.texture_coordinates.row(3 * f).swap(file.texture_coordinates.row(3 * f + 1));
  }
  Warnings warnings;
  const WeldedSurface repaired = repairSurface(file, "torus", &warnings);
  EXPECT_EQ(examineEdges(repaired.mesh.triangles).inconsistent, 0);
  EXPECT_NEAR(std::abs(enclosedVolume(repaired.mesh.vertices, repaired.mesh.triangles)),
              enclosedVolume(mesh.vertices, mesh.triangles), 1e-12);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(repaired.texture_coordinates.row(3 * f + k),
                mesh.vertices.row(repaired.mesh.triangles(f, k)));
    }
  }
}

TEST(RepairSurface, DropsFlatAndRepeatedTriangles) {
  TriangleMesh mesh = test::torus(1.0, 0.3, 24, 12);
  const Eigen::Index sound = mesh.triangles.rows();
  mesh.triangles.conservativeResize(sound + 2, 3);
  mesh.triangles.row(sound) << 0, 1, 1;
  mesh.triangles.row(sound + 1) = mesh.triangles.row(5).reverse();
  Warnings warnings;
  EXPECT_EQ(repairSurface({mesh, {}}, "torus", &warnings).mesh.triangles.rows(), sound);
  EXPECT_EQ(warnings.size(), 2U);
}

/// The far vertices would make the mesh so large that all others were welded.
TEST(RepairSurface, DropsFarVerticesOfNoTriangleAndOfFlatOnesBeforeItMeasures) {
  const TriangleMesh torus = test::torus(1.0, 0.3, 24, 12);
  TriangleMesh mesh{Points(torus.vertices.rows() + 3, 3), Triangles(torus.triangles.rows() + 2, 3)};
  mesh.vertices << Eigen::RowVector3d(1e9, 0, 0), torus.vertices, Eigen::RowVector3d(0, 1e9, 0),
      Eigen::RowVector3d(0, 2e9, 0);
  const int last = static_cast<int>(mesh.vertices.rows()) - 1;
  mesh.triangles << Eigen::RowVector3i(1, 1, last), torus.triangles.array() + 1,
      Eigen::RowVector3i(last, last - 1, last);
  Warnings warnings;
  const WeldedSurface repaired = repairSurface({mesh, {}}, "torus", &warnings);
  EXPECT_EQ(repaired.mesh.vertices, torus.vertices);
  EXPECT_EQ(repaired.mesh.triangles, torus.triangles);
  EXPECT_EQ(repaired.vertex_parents.front(), 1);
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_EQ(warnings[0], "torus: 1 vertices that no triangle uses were dropped");
  EXPECT_EQ(warnings[1], "torus: 2 vertices of triangles without area were dropped");
}

TEST(RepairSurface, RefusesAMeshWithoutArea) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  Warnings warnings;
  EXPECT_TRUE(says(complaint([&] { loadSurface(path, 1.0, &warnings); }), "no triangle has an area"));
}

TEST(LoadVisualMesh, ScalesAndFillsTheTopology) {
  const test::ScratchFolder folder;
  const TriangleMesh mesh = test::torus(100.0, 30.0, 24, 12);
  writeObj(folder.file("torus.obj"), mesh);
  ObjectDescription description;
  description.visual_mesh = folder.file("torus.obj");
  description.unit_m = 0.001;
  Warnings warnings;
  const MeshTopology topology = loadVisualMesh(description, &warnings);
  EXPECT_TRUE(topology.rest_vertices.isApprox(1e-3 * mesh.vertices, 1e-15));
  EXPECT_EQ(topology.revision, 0U);
  EXPECT_EQ(topology.triangle_pieces, std::vector<std::uint32_t>(576, 0));
  EXPECT_EQ(topology.cut, std::vector<bool>(576, false));
  EXPECT_TRUE(warnings.empty());
}

TEST(LoadVisualMesh, AHoleIsFilledAndAFinIsDropped) {
  const TriangleMesh ring = test::torus(1.0, 0.3, 24, 12);
  TriangleMesh mesh{Points(ring.vertices.rows() + 1, 3), Triangles(ring.triangles.rows(), 3)};
  mesh.vertices << ring.vertices, Eigen::RowVector3d(2.0, 0.0, 0.0);
  // A fin on one edge, and a hole where the last triangle was.
  mesh.triangles << ring.triangles.topRows(ring.triangles.rows() - 1),
      Eigen::RowVector3i(ring.triangles(0, 0), ring.triangles(0, 1), static_cast<int>(ring.vertices.rows()));
  const test::ScratchFolder folder;
  writeObj(folder.file("fin.obj"), exploded(mesh).mesh);
  ObjectDescription description;
  description.visual_mesh = folder.file("fin.obj");
  Warnings warnings;
  const MeshTopology topology = loadVisualMesh(description, &warnings);
  EXPECT_EQ(topology.rest_vertices.rows(), ring.vertices.rows());
  EXPECT_TRUE(examineEdges(topology.triangles).closed());
  EXPECT_NEAR(enclosedVolume(topology.rest_vertices, topology.triangles),
              enclosedVolume(ring.vertices, ring.triangles), 1e-9);
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_TRUE(says(warnings[1], "1 surfaces that enclose no volume were dropped; the largest: 1 triangles"));
  EXPECT_TRUE(says(warnings[2], "1 holes were filled"));
}

TEST(LoadVisualMesh, DISABLED_ToyIsWeldedAndKeepsItsBranchingEdges) {
  ObjectDescription description;
  description.visual_mesh = test::sharedData("toys/toy_surface.obj");
  Warnings warnings;
  const MeshTopology topology = loadVisualMesh(description, &warnings);
  EXPECT_EQ(topology.rest_vertices.rows(), 3896);
  EXPECT_EQ(examineEdges(topology.triangles).branching, 6);
}

}  // namespace
}  // namespace softbody
