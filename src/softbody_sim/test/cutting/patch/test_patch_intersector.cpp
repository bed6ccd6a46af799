#include <gtest/gtest.h>

#include <random>

#include "cutting/patch/cut_patch.h"
#include "cutting/patch/patch_intersector.h"
#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::randomPoints;

/// Reference test: solves for the crossing of a segment and a triangle.
bool crosses(const TriangleMesh& mesh, Eigen::Index f, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix3d system;
  const Eigen::Vector3d p = mesh.vertices.row(mesh.triangles(f, 0));
  system << mesh.vertices.row(mesh.triangles(f, 1)).transpose() - p,
      mesh.vertices.row(mesh.triangles(f, 2)).transpose() - p, a - b;
  const Eigen::Vector3d x = system.inverse() * (a - p);
  return x.minCoeff() >= 0.0 && x[0] + x[1] <= 1.0 && x[2] <= 1.0;
}

TEST(PatchIntersector, FindsWhatEveryTriangleByItselfSays) {
  std::mt19937 random(1);
  TriangleMesh soup{randomPoints(120, 0.1, &random), Triangles(200, 3)};
  for (int& vertex : soup.triangles.reshaped()) vertex = static_cast<int>(random() % 120);
  const PatchIntersector intersector(soup);
  const Points ends = randomPoints(2000, 0.12, &random);
  std::size_t total = 0;
  for (Eigen::Index k = 0; k < 1000; ++k) {
    const Eigen::Vector3d a = ends.row(2 * k), b = ends.row(2 * k + 1);
    std::size_t expected = 0;
    for (Eigen::Index f = 0; f < 200; ++f) expected += crosses(soup, f, a, b) ? 1 : 0;
    const std::vector<PatchHit> hits = intersector.hits(a, b);
    ASSERT_EQ(hits.size(), expected) << k;
    for (const PatchHit& hit : hits) EXPECT_TRUE(crosses(soup, hit.triangle, a, b));
    total += expected;
  }
  EXPECT_GT(total, 1000u);
}

TEST(PatchIntersector, ClosedSurfaceSeparatesInsideFromOutsideThroughItsEdgesAndVerticesToo) {
  const TetTopology box = boxTopology({4, 4, 4}, {1.0, 1.0, 1.0});
  const PatchIntersector intersector({box.rest_vertices, box.surface});
  for (double x = -0.25; x <= 1.25; x += 0.125) {
    for (double y = -0.25; y <= 1.25; y += 0.125) {
      const bool inside = x > 0.0 && x < 1.0 && y > 0.0 && y < 1.0;
      const bool border = (x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0) && !inside;
      if (border) continue;
      EXPECT_EQ(intersector.separates({0.4, 0.3, 3.0}, {x, y, 0.5}), inside) << x << ' ' << y;
      EXPECT_EQ(intersector.separates({x, y, 3.0}, {x, y, 0.5}), inside) << x << ' ' << y;
      EXPECT_FALSE(intersector.separates({x, y, 3.0}, {x, y, -3.0})) << x << ' ' << y;
    }
  }
}

TEST(PatchIntersector, ReversedSegmentCrossesTheSameTrianglesTheOtherWay) {
  std::mt19937 random(2);
  const TetTopology box = boxTopology({3, 3, 3}, {0.1, 0.1, 0.1});
  const PatchIntersector intersector({box.rest_vertices, box.surface});
  const Points ends = randomPoints(400, 0.2, &random);
  for (Eigen::Index k = 0; k < 200; ++k) {
    const std::vector<PatchHit> there = intersector.hits(ends.row(2 * k), ends.row(2 * k + 1));
    const std::vector<PatchHit> back = intersector.hits(ends.row(2 * k + 1), ends.row(2 * k));
    ASSERT_EQ(there.size(), back.size());
    for (std::size_t h = 0; h < there.size(); ++h) {
      const PatchHit& other = back[back.size() - 1 - h];
      EXPECT_EQ(there[h].triangle, other.triangle);
      EXPECT_NE(there[h].along_normal, other.along_normal);
      EXPECT_NEAR(there[h].t, 1.0 - other.t, 1e-9);
    }
  }
}

TEST(RuledPatch, LiesBetweenItsEdgesAndAgreesInOrientation) {
  Points before(3, 3), now(3, 3);
  before << 0, 0, 0, 0, 0, 1, 0, 0, 2;
  now << 1, 0, 0, 1, 0.2, 1, 1, 0.4, 2;
  const CutPatch patch = ruledPatch(before, now);
  EXPECT_EQ(patch.triangles.rows(), 4);
  const PatchIntersector intersector(patch);
  for (double z = 0.05; z < 2.0; z += 0.1) {
    const std::vector<PatchHit> hits = intersector.hits({0.5, -1.0, z}, {0.5, 1.0, z});
    ASSERT_EQ(hits.size(), 1u) << z;
    EXPECT_EQ(hits[0].along_normal, intersector.hits({0.5, -1.0, 0.5}, {0.5, 1.0, 0.5})[0].along_normal);
    // Two triangles deviate from a quadrilateral twisted by 0.2 by at most a quarter of that.
    EXPECT_NEAR(-1.0 + 2.0 * hits[0].t, 0.1 * z, 0.05 + 1e-12);
  }
  EXPECT_THROW(ruledPatch(before, now.topRows<2>()), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
