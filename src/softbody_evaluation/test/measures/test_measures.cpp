#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "softbody_evaluation/measures/depth_residual.h"
#include "softbody_evaluation/measures/statistics.h"
#include "softbody_evaluation/measures/vertex_error.h"
#include "softbody_evaluation/measures/volume.h"

namespace softbody::evaluation {
namespace {

MeshState stateOf(const Points& vertices) {
  MeshState state;
  state.vertices = vertices;
  state.confidence.assign(static_cast<std::size_t>(vertices.rows()), 1.0f);
  return state;
}

std::vector<int> identity(Eigen::Index count) {
  std::vector<int> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

TriangleMesh cube(double side) {
  TriangleMesh mesh{Points(8, 3), Triangles(12, 3)};
  for (int i = 0; i < 8; ++i)
    mesh.vertices.row(i) << side * (i & 1), side * (i >> 1 & 1), side * (i >> 2 & 1);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2,
      1, 3, 7, 1, 7, 5;
  return mesh;
}

TEST(Statistics, OfOneToAHundred) {
  std::vector<float> values(100);
  std::iota(values.begin(), values.end(), 1.0f);
  std::shuffle(values.begin(), values.end(), std::mt19937(1));
  const Summary s = summarize(values);
  EXPECT_EQ(s.count, 100u);
  EXPECT_DOUBLE_EQ(s.mean, 50.5);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(3383.5));
  EXPECT_EQ(s.median, 50.0);
  EXPECT_EQ(s.p95, 95.0);
  EXPECT_EQ(s.max, 100.0);
  EXPECT_DOUBLE_EQ(shareWithin(values, 25.0), 0.25);
}

TEST(Statistics, OfNothingIsNoNumber) {
  EXPECT_EQ(summarize(std::vector<float>()).count, 0u);
  EXPECT_TRUE(std::isnan(summarize(std::vector<float>()).mean));
  EXPECT_TRUE(std::isnan(shareWithin({}, 1.0)));
  EXPECT_EQ(slope({1.0}, {2.0}), 0.0);
}

TEST(VertexError, AKnownDisplacementIsTheError) {
  const Points truth = Points::Random(50, 3);
  Points result = truth;
  result.rowwise() += Eigen::RowVector3d(0.003, 0.0, -0.004);
  MeshState expected = stateOf(truth);
  for (int i = 0; i < 20; ++i) expected.confidence[static_cast<std::size_t>(i)] = 0.0f;
  result.topRows(20) = truth.topRows(20).rowwise() + Eigen::RowVector3d(0.0, 0.01, 0.0);
  const FrameVertexError frame = vertexError(stateOf(result), expected, identity(50));
  const VertexErrorReport report = summarize(std::vector<FrameVertexError>{frame});
  EXPECT_EQ(report.visible.count, 30u);
  EXPECT_EQ(report.hidden.count, 20u);
  EXPECT_NEAR(report.visible.mean, 0.005, 1e-9);
  EXPECT_NEAR(report.visible.max, 0.005, 1e-9);
  EXPECT_NEAR(report.hidden.rms, 0.010, 1e-9);
  EXPECT_NEAR(report.all.mean, 0.007, 1e-9);
}

TEST(VertexError, GrowingErrorIsDrift) {
  const Points truth = Points::Random(10, 3);
  std::vector<FrameVertexError> frames;
  for (int k = 0; k < 30; ++k) {
    Points result = truth;
    result.col(1).array() += 1e-4 * k;
    frames.push_back(vertexError(stateOf(result), stateOf(truth), identity(10)));
    frames.back().stamp = 1'600'000'000'000'000'000 + k * 100'000'000LL;
  }
  EXPECT_NEAR(summarize(frames).drift_m_per_s, 1e-3, 1e-8);
}

TEST(VertexError, WeldedAndNewVerticesAreMatchedThroughTheirParents) {
  // The result dropped the input's vertices 1 and 3, copied vertex 4 and made one by a cut; so did the truth.
  const std::vector<int> matches = matchVertices({0, 2, 4, 4, -1}, {-1, 0, 1, 2, 3, 4});
  EXPECT_EQ(matches, (std::vector<int>{1, 3, 5, 5, -1}));
  const Points truth = Points::Random(6, 3);
  Points result(5, 3);
  result << truth.row(1), truth.row(3), truth.row(5), truth.row(5), Eigen::RowVector3d::Constant(9.0);
  const FrameVertexError frame = vertexError(stateOf(result), stateOf(truth), matches);
  EXPECT_EQ(frame.visible.size(), 4u);
  EXPECT_EQ(frame.mean(), 0.0);
}

TEST(VertexError, StatesThatDoNotFitAreRefused) {
  EXPECT_THROW(vertexError(stateOf(Points::Zero(4, 3)), stateOf(Points::Zero(5, 3)), identity(5)),
               std::invalid_argument);
  EXPECT_THROW(vertexError(stateOf(Points::Zero(5, 3)), stateOf(Points::Zero(4, 3)), identity(5)),
               std::invalid_argument);
}

TEST(DepthResidual, AKnownOffsetIsTheResidual) {
  const cv::Mat1f model(30, 40, 0.5f), measured(30, 40, 0.507f);
  const FrameResidual frame = depthResidual(model, measured, 0.03);
  EXPECT_EQ(frame.residuals.size(), 1200u);
  for (const float residual : frame.residuals) EXPECT_FLOAT_EQ(residual, 0.507f - 0.5f);
}

TEST(DepthResidual, OccludersAndMissingDepthAreCountedAndLeftOut) {
  cv::Mat1f model(10, 10, 0.5f), measured(10, 10, 0.512f);
  model.row(0).setTo(0.0f);      // the model is not there
  measured.row(1).setTo(0.40f);  // a hand before it
  measured.row(2).setTo(0.0f);   // holes
  measured.row(3).setTo(std::numeric_limits<float>::quiet_NaN());
  measured.row(4).setTo(0.471f);  // nearer, but by less than an occluder
  measured.row(5).setTo(0.8f);    // the model is where nothing is
  const FrameResidual frame = depthResidual(model, measured, 0.03);
  EXPECT_EQ(frame.model_pixels, 90u);
  EXPECT_EQ(frame.occluded, 10u);
  EXPECT_EQ(frame.without_depth, 20u);
  EXPECT_EQ(frame.residuals.size(), 60u);
  const ResidualReport report = summarize(std::vector<FrameResidual>{frame}, 0, 1);
  EXPECT_NEAR(report.residual.max, 0.3, 1e-6);
  EXPECT_NEAR(report.residual.median, 0.012, 1e-6);
  EXPECT_EQ(report.within_10mm, 0.0);
  EXPECT_NEAR(report.within_15mm, 40.0 / 60.0, 1e-12);
  EXPECT_NEAR(report.within_15mm_of_measured, 40.0 / 70.0, 1e-12);
  EXPECT_EQ(report.answered, 1u);
  EXPECT_NEAR(report.occluded_share, 1.0 / 9.0, 1e-12);
  EXPECT_NEAR(report.without_depth_share, 2.0 / 9.0, 1e-12);
}

TEST(DepthResidual, NothingMeasuredIsNoMetricAndOcclusionNoHit) {
  const FrameResidual hidden = depthResidual(cv::Mat1f(4, 4, 0.6f), cv::Mat1f(4, 4, 0.5f), 0.03);
  const FrameResidual absent = depthResidual(cv::Mat1f(4, 4, 0.0f), cv::Mat1f(4, 4, 0.5f), 0.03);
  const ResidualReport report = summarize(std::vector<FrameResidual>{hidden, absent}, 0, 2);
  EXPECT_TRUE(std::isnan(report.residual.median));
  EXPECT_TRUE(std::isnan(report.within_15mm));
  EXPECT_EQ(report.within_15mm_of_measured, 0.0);
  EXPECT_EQ(report.frames, 2u);
  EXPECT_EQ(report.answered, 1u);
}

TEST(DepthResidual, WindowsHoldTheirOwnFrames) {
  std::vector<FrameResidual> frames;
  for (int k = 0; k < 5; ++k) {
    frames.push_back(
        depthResidual(cv::Mat1f(4, 4, 0.5f), cv::Mat1f(4, 4, 0.5f + 0.001f * static_cast<float>(k)), 0.03));
  }
  const ResidualReport last = summarize(frames, 4, 2);
  EXPECT_EQ(last.frames, 1u);
  EXPECT_NEAR(last.residual.median, 0.004, 1e-6);
  EXPECT_EQ(summarize(frames, 0, 5).residual.count, 80u);
}

TEST(DepthResidual, OtherSizesAreRefused) {
  EXPECT_THROW(depthResidual(cv::Mat1f(4, 4), cv::Mat1f(4, 5), 0.03), std::invalid_argument);
}

TEST(Volume, DriftOfAScaledCube) {
  const TriangleMesh mesh = cube(0.1);
  MeshTopology topology;
  topology.rest_vertices = mesh.vertices;
  topology.triangles = mesh.triangles;
  const MeshState same = stateOf(mesh.vertices), larger = stateOf(1.1 * mesh.vertices);
  const VolumeReport report = volumeDrift({{0, topology}}, {&same, &larger});
  ASSERT_TRUE(report.closed);
  EXPECT_NEAR(report.rest_m3, 1e-3, 1e-12);
  EXPECT_NEAR(report.change.largest, 0.331, 1e-9);
  EXPECT_NEAR(report.change.mean, 0.331 / 2.0, 1e-9);
}

TEST(Volume, OpenSurfacesHaveNone) {
  TriangleMesh mesh = cube(0.1);
  EXPECT_TRUE(isClosed(mesh.vertices, mesh.triangles));
  EXPECT_FALSE(isClosed(mesh.vertices, mesh.triangles.topRows(11)));
}

}  // namespace
}  // namespace softbody::evaluation
