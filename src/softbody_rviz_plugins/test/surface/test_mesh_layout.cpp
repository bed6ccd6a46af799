#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "shapes.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "surface/mesh_layout.h"

namespace softbody {
namespace {

constexpr double kSharp = 0.5, kNeverSharp = 4.0;  // crease angles [rad]

/// The triangles, as drawn, have the corners of the mesh's triangles.
void expectSameTriangles(const MeshTopology& topology, const MeshLayout& layout) {
  std::vector<Eigen::RowVector3i> skin, cut;
  for (Eigen::Index t = 0; t < topology.triangles.rows(); ++t)
    (topology.cut[t] ? cut : skin).push_back(topology.triangles.row(t));
  for (const auto& [part, expected] : {std::pair(0, skin), std::pair(1, cut)}) {
    ASSERT_EQ(layout.parts[part].size(), 3 * expected.size());
    for (std::size_t t = 0; t < expected.size(); ++t) {
      for (int k = 0; k < 3; ++k) EXPECT_EQ(layout.vertices[layout.parts[part][3 * t + k]], expected[t][k]);
    }
  }
}

TEST(MeshLayout, aSmoothSurfaceIsDrawnWithItsOwnVertices) {
  const MeshTopology box = boxSurface(3);
  const MeshLayout layout = layoutOfSurface(box, kNeverSharp);
  EXPECT_EQ(layout.vertices.size(), static_cast<std::size_t>(box.rest_vertices.rows()));
  expectSameTriangles(box, layout);
}

TEST(MeshLayout, theSidesOfABoxAreFlatWithASmallCreaseAngle) {
  const MeshTopology box = boxSurface(3);
  const MeshLayout layout = layoutOfSurface(box, kSharp);
  EXPECT_EQ(layout.vertices.size(), 6u * 4 * 4);
  expectSameTriangles(box, layout);
  for (const PlacedVertex& vertex : place(layout, box.rest_vertices, box.triangles)) {
    EXPECT_NEAR(vertex.normal.lpNorm<Eigen::Infinity>(), 1.0, 1e-6) << "along an axis";
    const Eigen::Vector3f from_center = vertex.position - Eigen::Vector3f::Constant(0.5f);
    EXPECT_GT(vertex.normal.dot(from_center), 0.4f) << "outward";
  }
}

TEST(MeshLayout, normalsTurnWithTheBody) {
  const MeshTopology box = boxSurface(2);
  const MeshLayout layout = layoutOfSurface(box, kNeverSharp);
  const Eigen::Isometry3d T =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized());
  const auto rest = place(layout, box.rest_vertices, box.triangles);
  const auto moved = place(layout, transformed(box.rest_vertices, T), box.triangles);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_LT((T.rotation().cast<float>() * rest[i].normal - moved[i].normal).norm(), 1e-5f);
    EXPECT_NEAR(moved[i].normal.norm(), 1.0f, 1e-5f);
  }
}

TEST(MeshLayout, aCutFaceSharesNoVertexWithTheSkin) {
  MeshTopology box = boxSurface(3);
  for (Eigen::Index t = 0; t < box.triangles.rows(); ++t)
    box.cut[t] = (box.rest_vertices(box.triangles.row(t), 0).array() == 0.0).all();
  const MeshLayout layout = layoutOfSurface(box, kNeverSharp);
  expectSameTriangles(box, layout);
  for (const std::uint32_t i : layout.parts[0])
    EXPECT_EQ(std::count(layout.parts[1].begin(), layout.parts[1].end(), i), 0);
  for (std::size_t i = 0; i < layout.vertices.size(); ++i) {
    const bool in_cut = std::count(layout.parts[1].begin(), layout.parts[1].end(), i) > 0;
    EXPECT_EQ(box.cut[layout.triangles[i]], in_cut);
  }
}

TEST(MeshLayout, aSeamOfTheTextureSplitsVerticesButNotNormals) {
  MeshTopology box = boxSurface(2);
  box.texture_coordinates.setZero(box.triangles.size(), 3);
  for (Eigen::Index corner = 0; corner < box.triangles.size(); ++corner)
    box.texture_coordinates(corner, 0) = corner / 3 < 12 ? 0.25 : 0.75;
  const MeshLayout layout = layoutOfSurface(box, kNeverSharp);
  expectSameTriangles(box, layout);
  EXPECT_GT(layout.vertices.size(), static_cast<std::size_t>(box.rest_vertices.rows()));
  EXPECT_EQ(layout.normal_count, box.rest_vertices.rows());
  for (std::size_t i = 0; i < layout.parts[0].size(); ++i) {
    const float expected = i / 3 < 12 ? 0.25f : 0.75f;
    EXPECT_EQ(layout.texture[layout.parts[0][i]].x(), expected);
  }
}

TEST(MeshLayout, facetsHaveTheNormalsOfTheirTriangles) {
  const MeshTopology box = boxSurface(2);
  const MeshLayout layout = layoutOfFacets(box.triangles);
  const auto placed = place(layout, box.rest_vertices, box.triangles);
  for (std::size_t i = 0; i < placed.size(); i += 3) {
    const Eigen::Vector3f normal =
        (placed[i + 1].position - placed[i].position).cross(placed[i + 2].position - placed[i].position);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(placed[i + k].normal.dot(normal.normalized()), 1.0f, 1e-6f);
  }
}

}  // namespace
}  // namespace softbody
