#include <gtest/gtest.h>

#include "fixtures/test_meshes.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {
namespace {

class Binding : public ::testing::Test {
 protected:
  Binding() {
    visual_.rest_vertices =
        testing::randomPoints(400, 0.5, &random_) * Eigen::Vector3d(0.22, 0.12, 0.05).asDiagonal();
    visual_.rest_vertices.rowwise() += Eigen::RowVector3d(0.1, 0.05, 0.015);
    // Also on the boundary of the volume and on its vertices.
    visual_.rest_vertices.topRows(132) = volume_.rest_vertices;
    visual_.revision = 3;
  }
  MeshState stateAt(const Points& vertices) const {
    MeshState state;
    state.vertices = vertices;
    state.observed = 77;
    state.confidence.assign(static_cast<std::size_t>(vertices.rows()), 1.0f);
    return state;
  }
  std::mt19937 random_{1};
  TetTopology volume_ = testing::sponge();
  MeshTopology visual_;
};

TEST_F(Binding, RestGivesRest) {
  const VisualSurface surface(visual_, volume_);
  const MeshState state = surface.apply(stateAt(volume_.rest_vertices));
  EXPECT_LT((state.vertices - visual_.rest_vertices).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(state.revision, 3u);
  EXPECT_EQ(state.observed, 77);
  for (float confidence : state.confidence) EXPECT_NEAR(confidence, 1.0f, 1e-5f);
}

TEST_F(Binding, KnowsWhatLiesOutside) {
  const VisualSurface surface(visual_, volume_);
  const TetLocator locator(volume_.rest_vertices, volume_.tets);
  int outside = 0;
  for (Eigen::Index v = 0; v < visual_.rest_vertices.rows(); ++v) {
    outside += locator.locate(visual_.rest_vertices.row(v)).barycentric.minCoeff() < -1e-5;
  }
  EXPECT_GT(outside, 20);
  EXPECT_EQ(surface.outsideCount(), outside);
}

TEST_F(Binding, MovesWithARigidBody) {
  const VisualSurface surface(visual_, volume_);
  const Eigen::Isometry3d T = testing::somePose();
  const MeshState state = surface.apply(stateAt(transformed(volume_.rest_vertices, T)));
  EXPECT_LT((state.vertices - transformed(visual_.rest_vertices, T)).cwiseAbs().maxCoeff(), 2e-7);
}

TEST_F(Binding, MovesWithAnAffineBody) {
  const VisualSurface surface(visual_, volume_);
  Eigen::Matrix3d A;
  A << 1.2, 0.3, -0.1, 0.0, 0.8, 0.2, 0.1, -0.2, 1.1;
  const MeshState state = surface.apply(stateAt(volume_.rest_vertices * A.transpose()));
  EXPECT_LT((state.vertices - visual_.rest_vertices * A.transpose()).cwiseAbs().maxCoeff(), 2e-7);
}

TEST_F(Binding, AgreesWithTheTetsOnTheirBoundary) {
  Points points(volume_.surface.rows(), 3);
  for (Eigen::Index f = 0; f < points.rows(); ++f) {
    points.row(f) = 0.2 * volume_.rest_vertices.row(volume_.surface(f, 0)) +
                    0.3 * volume_.rest_vertices.row(volume_.surface(f, 1)) +
                    0.5 * volume_.rest_vertices.row(volume_.surface(f, 2));
  }
  visual_.rest_vertices = points;
  const VisualSurface surface(visual_, volume_);
  const Points deformed = volume_.rest_vertices + testing::randomPoints(132, 0.01, &random_);
  const Points expected =
      applyBinding(bindPoints(points, volume_.rest_vertices, volume_.tets), deformed, volume_.tets);
  EXPECT_LT((surface.apply(stateAt(deformed)).vertices - expected).cwiseAbs().maxCoeff(), 2e-7);
}

TEST_F(Binding, IsContinuousAcrossTheBoundary) {
  MeshTopology inner = visual_, outer = visual_;
  inner.rest_vertices.resize(volume_.surface.rows(), 3);
  outer.rest_vertices.resize(volume_.surface.rows(), 3);
  const Points normals = vertexNormals(volume_.rest_vertices, volume_.surface);
  for (Eigen::Index f = 0; f < volume_.surface.rows(); ++f) {
    const Eigen::Vector3d a = volume_.rest_vertices.row(volume_.surface(f, 0)),
                          b = volume_.rest_vertices.row(volume_.surface(f, 1)),
                          c = volume_.rest_vertices.row(volume_.surface(f, 2));
    const Eigen::RowVector3d offset = 1e-6 * (b - a).cross(c - a).normalized().transpose();
    inner.rest_vertices.row(f) = ((a + b + c) / 3.0).transpose() - offset;
    outer.rest_vertices.row(f) = ((a + b + c) / 3.0).transpose() + offset;
  }
  const VisualSurface inside(inner, volume_), outside(outer, volume_);
  EXPECT_EQ(inside.outsideCount(), 0);
  EXPECT_EQ(outside.outsideCount(), static_cast<int>(volume_.surface.rows()));
  const MeshState state = stateAt(volume_.rest_vertices + testing::randomPoints(132, 0.005, &random_));
  EXPECT_LT((inside.apply(state).vertices - outside.apply(state).vertices).rowwise().norm().maxCoeff(), 1e-5);
}

TEST_F(Binding, InterpolatesConfidence) {
  const VisualSurface surface(visual_, volume_);
  MeshState state = stateAt(volume_.rest_vertices);
  for (Eigen::Index v = 0; v < 132; ++v)
    state.confidence[v] = static_cast<float>(5.0 * volume_.rest_vertices(v, 0));
  const MeshState result = surface.apply(state);
  for (Eigen::Index v = 0; v < visual_.rest_vertices.rows(); ++v) {
    const double expected = std::clamp(5.0 * visual_.rest_vertices(v, 0), 0.0, 1.0);
    EXPECT_NEAR(result.confidence[v], expected, 1e-5);
  }
}

TEST_F(Binding, RefusesStatesOfAnotherVolume) {
  const VisualSurface surface(visual_, volume_);
  MeshState state = stateAt(volume_.rest_vertices);
  state.revision = 1;
  EXPECT_THROW(surface.apply(state), std::invalid_argument);
  EXPECT_THROW(surface.apply(stateAt(volume_.rest_vertices.topRows(100))), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
