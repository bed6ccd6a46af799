#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fixtures/test_meshes.h"
#include "softbody_sim/surface_mesh/closest_point.h"
#include "surface_mesh/closest_surface_point.h"

namespace softbody {
namespace {

/// The boundary of the sponge, somewhere, with random deviations.
struct SpongeSurface {
  MeshTopology topology;
  MeshState state;

  explicit SpongeSurface(std::mt19937* random) {
    const TetTopology volume = testing::sponge();
    topology.rest_vertices = volume.rest_vertices;
    topology.triangles = volume.surface;
    topology.triangle_pieces.assign(static_cast<std::size_t>(volume.surface.rows()), 3);
    state.vertices = transformed(volume.rest_vertices, testing::somePose());
    const auto count = static_cast<std::size_t>(state.vertices.rows());
    std::uniform_real_distribution<float> uniform(0.001f, 0.005f);
    for (std::size_t v = 0; v < count; ++v) state.standard_deviation.push_back(uniform(*random));
    state.confidence = state.standard_deviation;
  }
};

TEST(ClosestSurfacePoint, AgreesWithTheTreeOfCgal) {
  std::mt19937 random(4);
  const SpongeSurface sponge(&random);
  const ClosestPointQuery tree(sponge.state.vertices, sponge.topology.triangles);
  const Points points = testing::randomPoints(200, 0.6, &random);
  for (const auto& row : points.rowwise()) {
    const Eigen::Vector3d point = row;
    const ClosestSurfacePoint closest = closestSurfacePoint(sponge.topology, sponge.state, point);
    EXPECT_NEAR((closest.position - point).norm(), (tree.closest(point).position - point).norm(), 1e-9);
    EXPECT_GE(closest.normal.dot(point - closest.position), -1e-9);  // outside of a convex body
    EXPECT_NEAR(closest.normal.norm(), 1.0, 1e-9);
    EXPECT_EQ(closest.piece, 3U);
  }
}

TEST(ClosestSurfacePoint, HasTheDeviationOfAVertexAtTheVertexAndBetweenThemElsewhere) {
  std::mt19937 random(5);
  const SpongeSurface sponge(&random);
  for (Eigen::Index v = 0; v < sponge.state.vertices.rows(); v += 7) {
    const auto closest = closestSurfacePoint(sponge.topology, sponge.state, sponge.state.vertices.row(v));
    EXPECT_NEAR(closest.standard_deviation, sponge.state.standard_deviation[static_cast<std::size_t>(v)],
                1e-7);
    EXPECT_EQ(closest.confidence, closest.standard_deviation);
  }
  const Points points = testing::randomPoints(100, 0.6, &random);
  for (const auto& row : points.rowwise()) {
    const auto closest = closestSurfacePoint(sponge.topology, sponge.state, row.transpose());
    float least = 1.0f, largest = 0.0f;
    for (const int v : sponge.topology.triangles.row(closest.triangle)) {
      least = std::min(least, sponge.state.standard_deviation[static_cast<std::size_t>(v)]);
      largest = std::max(largest, sponge.state.standard_deviation[static_cast<std::size_t>(v)]);
    }
    EXPECT_GE(closest.standard_deviation, least - 1e-7f);
    EXPECT_LE(closest.standard_deviation, largest + 1e-7f);
  }
}

TEST(ClosestSurfacePoint, SaysWhatItDoesNotKnow) {
  std::mt19937 random(6);
  SpongeSurface sponge(&random);
  sponge.state.standard_deviation.clear();
  const auto closest = closestSurfacePoint(sponge.topology, sponge.state, Eigen::Vector3d::Zero());
  EXPECT_TRUE(std::isnan(closest.standard_deviation));
  sponge.state.revision = 1;
  EXPECT_THROW(closestSurfacePoint(sponge.topology, sponge.state, Eigen::Vector3d::Zero()),
               std::invalid_argument);
  EXPECT_THROW(closestSurfacePoint({}, {}, Eigen::Vector3d::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
