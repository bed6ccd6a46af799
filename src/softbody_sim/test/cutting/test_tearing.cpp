#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/cutting/manifold.h"
#include "core/cutting/tearing.h"
#include "cut_bodies.h"

namespace softbody {
namespace {

/// The sponge with the part from x = 90 to 110 mm stretched to `factor` times its length.
Points stretchedMiddle(const Points& rest, double factor) {
  Points x = rest;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    x(v, 0) += (factor - 1.0) * std::clamp(rest(v, 0) - 0.08, 0.0, 0.04);
  }
  return x;
}

std::vector<bool> uncut(const TetTopology& body) {
  return std::vector<bool>(static_cast<std::size_t>(body.surface.rows()), false);
}

TEST(Tearing, StrainAlongTheNormalDecides) {
  const TetTopology sponge = testing::sponge();
  // Stretched by 1.5 along x: Green strain (1.5^2 - 1) / 2 = 0.625 along x, none across.
  Points x = sponge.rest_vertices;
  x.col(0) *= 1.5;
  EXPECT_TRUE(overstrainedFaces(sponge, x, 0.63).empty());
  const std::vector<Face> faces = overstrainedFaces(sponge, x, 0.62);
  EXPECT_FALSE(faces.empty());
  for (const Face& face : faces) {
    EXPECT_EQ(sponge.rest_vertices(face[0], 0), sponge.rest_vertices(face[1], 0));
    EXPECT_EQ(sponge.rest_vertices(face[0], 0), sponge.rest_vertices(face[2], 0));
  }
}

TEST(Tearing, ATurnedBodyDoesNotTear) {
  const TetTopology sponge = testing::sponge();
  const Points x = transformed(sponge.rest_vertices, testing::somePose());
  std::vector<Face> closed;
  EXPECT_FALSE(tearTets(sponge, uncut(sponge), x, 1e-6, &closed).has_value());
}

TEST(Tearing, TearsApartWhereItIsStretchedIntoSoundPieces) {
  const TetTopology sponge = testing::sponge();
  std::vector<Face> closed;
  const auto edit = tearTets(sponge, uncut(sponge), stretchedMiddle(sponge.rest_vertices, 1.8), 0.5, &closed);
  ASSERT_TRUE(edit.has_value());
  const TetTopology& after = edit->topology;
  EXPECT_GE(*std::max_element(after.bodies.begin(), after.bodies.end()), 1u);
  EXPECT_EQ(nonManifoldVertices(after.surface), std::vector<int>());
  EXPECT_EQ(after.tets.rows(), sponge.tets.rows());
  EXPECT_NEAR(enclosedVolume(after.rest_vertices, after.surface) / (0.2 * 0.1 * 0.03), 1.0, 1e-6);
  EXPECT_NE(std::count(edit->cut.begin(), edit->cut.end(), true), 0);
}

TEST(Tearing, RandomStrainLeavesTheSurfaceManifold) {
  for (const TetTopology& body : {testing::sponge(), testing::torus()}) {
    std::mt19937 random(4);
    for (int k = 0; k < 40; ++k) {
      TetTopology topology = body;
      std::vector<bool> cut = uncut(body);
      std::vector<Face> closed;
      for (int step = 0; step < 3; ++step) {
        const Points x =
            topology.rest_vertices + testing::randomPoints(topology.rest_vertices.rows(), 0.01, &random);
        const auto edit = tearTets(topology, cut, x, 0.4, &closed);
        if (!edit) continue;
        topology = edit->topology;
        cut = edit->cut;
        ASSERT_EQ(nonManifoldVertices(topology.surface), std::vector<int>());
        ASSERT_EQ(topology.surface, boundaryTriangles(topology.tets));
      }
    }
  }
}

}  // namespace
}  // namespace softbody
