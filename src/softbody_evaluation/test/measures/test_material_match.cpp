#include "measures/material_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fixtures/grid_bodies.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_evaluation/measures/vertex_error.h"

namespace softbody::evaluation {
namespace {

/// A bent and twisted body: the place of the material that is at `p` at rest.
Eigen::Vector3d bent(const Eigen::Vector3d& p) {
  return {p.x(), p.y() + 2.0 * p.x() * p.x(), 0.5 + p.z() + p.x() * p.y() + 0.3 * p.x()};
}

MeshState stateOf(const MeshTopology& mesh, const Eigen::Isometry3d& material) {
  MeshState state;
  state.vertices = transformed(mesh.rest_vertices, material);
  for (Eigen::Index v = 0; v < state.vertices.rows(); ++v)
    state.vertices.row(v) = bent(state.vertices.row(v).transpose()).transpose();
  state.confidence.assign(mesh.vertex_parents.size(), 1.0f);
  return state;
}

FrameVertexError errorOf(const MaterialMap& map, const MeshTopology& mesh, const MeshState& result,
                         const MeshState& truth) {
  const VertexMatches matches = matchMaterial(map, mesh, mesh, 0.002);
  return vertexError(ontoVertices(result, truth, matches), truth, matches.vertices);
}

float largestOf(const FrameVertexError& error) {
  return *std::max_element(error.visible.begin(), error.visible.end());
}

TEST(MaterialMatch, WithoutAMotionItIsTheMatchByFile) {
  const MeshTopology mesh = spongeBox();
  const VertexMatches matches = matchMaterial(MaterialMap(), mesh, mesh, 0.002);
  EXPECT_EQ(matches.vertices, mesh.vertex_parents);
  EXPECT_TRUE(matches.between.empty());
}

TEST(MaterialMatch, VerticesThatAreSymmetricAreExchanged) {
  const MeshTopology mesh = spongeBox();
  const Eigen::Isometry3d motion = turned(M_PI, Eigen::Vector3d::UnitZ());
  const VertexMatches matches = matchMaterial(materialMap(motion, mesh, mesh), mesh, mesh, 0.002);
  EXPECT_TRUE(matches.between.empty());
  EXPECT_EQ(std::set<int>(matches.vertices.begin(), matches.vertices.end()).size(), matches.vertices.size());
  const MeshState truth = stateOf(mesh, Eigen::Isometry3d::Identity()), result = stateOf(mesh, motion);
  EXPECT_GT(largestOf(errorOf(MaterialMap(), mesh, result, truth)), 0.1f);
  EXPECT_LT(largestOf(errorOf(materialMap(motion, mesh, mesh), mesh, result, truth)), 1e-7f);
}

TEST(MaterialMatch, OtherVerticesAreComparedWithThePlaceBetweenThoseOfTheTruth) {
  // Lines that crowd at one end of each side: the box is symmetric, its vertices are not.
  const MeshTopology mesh = spongeBox([](double x) { return x + 0.25 * (1.0 - x * x); });
  const Eigen::Isometry3d motion = turned(M_PI, Eigen::Vector3d::UnitZ());
  const MaterialMap map = materialMap(motion, mesh, mesh);
  EXPECT_FALSE(matchMaterial(map, mesh, mesh, 0.002).between.empty());
  const MeshState truth = stateOf(mesh, Eigen::Isometry3d::Identity());
  MeshState result = stateOf(mesh, motion);
  // A triangle of the truth is a chord of the bent surface: sag = curvature / 8 * edge^2, edges up to 40 mm.
  EXPECT_LT(largestOf(errorOf(map, mesh, result, truth)), 4.0f / 8.0f * 0.04f * 0.04f);
  // An error of the result is measured as it is.
  result.vertices.col(0).array() += 0.02;
  const FrameVertexError shifted = errorOf(map, mesh, result, truth);
  EXPECT_NEAR(shifted.mean(), 0.02, 1e-3);
  EXPECT_EQ(shifted.unmatched, 0u);
}

TEST(MaterialMatch, AnotherMeshOfTheSameBodyHasOnlyTheErrorOfTheResult) {
  const MeshTopology truth = spongeBox();
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(0.3, -0.1, 0.2) * turned(2.0, Eigen::Vector3d(1.0, 2.0, -1.0));
  MeshTopology mesh = gridBox({0.2, 0.1, 0.04}, {19, 11, 5}, [](double x) { return x; });
  mesh.rest_vertices = transformed(mesh.rest_vertices, motion.inverse());
  const MaterialMap map = materialMap(motion, mesh, truth);
  const MeshState true_state = stateOf(truth, Eigen::Isometry3d::Identity());
  const auto errorAfter = [&](const Eigen::RowVector3d& shift) {
    MeshState result = stateOf(mesh, motion);
    result.vertices.rowwise() += shift;
    const VertexMatches matches = matchMaterial(map, mesh, truth, 0.002);
    return vertexError(ontoVertices(result, true_state, matches), true_state, matches.vertices);
  };
  const FrameVertexError none = errorAfter({0.0, 0.0, 0.0});
  EXPECT_EQ(none.unmatched, 0u);
  EXPECT_EQ(none.visible.size(), static_cast<std::size_t>(mesh.rest_vertices.rows()));
  EXPECT_LT(largestOf(none), 4.0f / 8.0f * 0.04f * 0.04f);       // the sag of the truth's triangles
  EXPECT_NEAR(errorAfter({0.02, 0.0, 0.0}).mean(), 0.02, 1e-3);  // most of it slides along the surface
  EXPECT_NEAR(errorAfter({0.0, 0.0, 0.02}).mean(), 0.02, 1e-3);
}

}  // namespace
}  // namespace softbody::evaluation
