#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "softbody_evaluation/measures/pose_error.h"
#include "softbody_evaluation/measures/silhouette.h"
#include "softbody_evaluation/measures/steadiness.h"
#include "softbody_evaluation/measures/vertex_error.h"

namespace softbody::evaluation {
namespace {

MeshState at(double x) {
  MeshState state;
  state.vertices = Points::Zero(4, 3);
  state.vertices.col(0).setConstant(x);
  state.confidence.assign(4, 1.0f);
  return state;
}

std::vector<const MeshState*> pointers(const std::vector<MeshState>& states) {
  std::vector<const MeshState*> result;
  for (const MeshState& state : states) result.push_back(&state);
  return result;
}

TEST(Drift, IsTheLastWindowAgainstTheFirst) {
  // 20 s at 10 Hz; 1 mm in the first five seconds, 9 mm between, 3 mm in the last five.
  std::vector<FrameVertexError> frames;
  for (int k = 0; k <= 200; ++k) {
    const double error = k <= 50 ? 0.001 : k < 150 ? 0.009 : 0.003;
    frames.push_back(vertexError(at(error), at(0.0), {0, 1, 2, 3}));
    frames.back().stamp = k * 100'000'000LL;
  }
  const VertexErrorReport report = summarize(frames);
  EXPECT_EQ(report.drift_window_s, 5.0);
  EXPECT_NEAR(report.drift_m, 0.002, 1e-8);
  EXPECT_NEAR(report.drift_ratio, 3.0, 1e-5);
}

TEST(Jitter, IsMeasuredOnlyWhereTheTruthIsStill) {
  std::vector<MeshState> truth, result;
  for (int k = 0; k < 60; ++k) {
    const double x = k < 20 ? 0.0 : k < 40 ? 0.01 * (k - 19) : 0.2;
    truth.push_back(at(x));
    // Trembles by 0.5 mm about a wrong place; only while the truth moves by 50 mm.
    result.push_back(at(x + 0.007 + (k >= 20 && k < 40 ? 0.05 : 0.0005) * (k % 2 == 0 ? 1.0 : -1.0)));
  }
  const std::vector<FrameRange> still = stillRanges(pointers(truth), 1e-4, 10);
  ASSERT_EQ(still.size(), 2u);
  EXPECT_EQ(still[0].last, 20u);
  // The last moving frame is already at the place of rest's.
  EXPECT_EQ(still[1].first, 39u);
  std::vector<const MeshState*> answers = pointers(result);
  answers[39] = nullptr;
  const JitterReport report = jitter(answers, still);
  EXPECT_EQ(report.frames, 40u);
  EXPECT_NEAR(report.per_vertex.rms, 0.0005, 1e-7);
  EXPECT_NEAR(report.per_vertex.max, 0.0005, 1e-7);
}

TEST(Jitter, ANewTopologyOfTheResultIsNoJitter) {
  std::vector<MeshState> result;
  for (int k = 0; k < 30; ++k) {
    result.push_back(at(k % 2 == 0 ? 0.001 : -0.001));
    if (k < 15) continue;
    result.back() = at(0.3);
    result.back().revision = 1;
  }
  const JitterReport report = jitter(pointers(result), {{0, 30}});
  EXPECT_EQ(report.frames, 30u);
  EXPECT_EQ(report.per_vertex.count, 8u);
  EXPECT_NEAR(report.per_vertex.max, 0.001, 1e-5);
}

TEST(Jitter, AStillResultHasNone) {
  const std::vector<MeshState> states(30, at(0.3));
  EXPECT_NEAR(jitter(pointers(states), {{0, 30}}).per_vertex.max, 0.0, 1e-12);
}

TEST(Silhouette, ShiftedSquares) {
  cv::Mat1b a = cv::Mat1b::zeros(100, 100), b = a.clone();
  a(cv::Rect(10, 10, 40, 40)).setTo(255);
  b(cv::Rect(20, 10, 40, 40)).setTo(255);
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, b), 30.0 / 50.0);
  EXPECT_EQ(intersectionOverUnion(a, a), 1.0);
  EXPECT_EQ(intersectionOverUnion(a, cv::Mat1b::zeros(100, 100)), 0.0);
  EXPECT_EQ(intersectionOverUnion(cv::Mat1b::zeros(9, 9), cv::Mat1b::zeros(9, 9)), 1.0);
  EXPECT_THROW(intersectionOverUnion(a, cv::Mat1b::zeros(9, 9)), std::invalid_argument);
}

TEST(Silhouette, MeasuredIsWhatIsAtTheModelsDepth) {
  cv::Mat1f model(10, 10, 0.0f), measured(10, 10, 1.5f);
  model(cv::Rect(0, 0, 5, 5)).setTo(0.5f);
  measured(cv::Rect(0, 0, 5, 10)).setTo(0.52f);
  measured.row(0).setTo(std::numeric_limits<float>::quiet_NaN());
  const cv::Mat1b mask = measuredSilhouette(measured, model, 0.03);
  EXPECT_EQ(cv::countNonZero(mask), 45);
  EXPECT_EQ(cv::countNonZero(measuredSilhouette(measured, cv::Mat1f::zeros(10, 10), 0.03)), 0);
}

TEST(Silhouette, WhatIsFarBesideTheModelIsNotTheBody) {
  cv::Mat1f model(100, 100, 0.0f);
  model(cv::Rect(40, 40, 20, 20)).setTo(0.5f);
  const cv::Mat1b mask = measuredSilhouette(cv::Mat1f(100, 100, 0.5f), model, 0.03);
  EXPECT_EQ(cv::countNonZero(mask), 50 * 50);
}

TEST(PoseError, AKnownMotionIsTheError) {
  PoseRecord truth, result;
  for (int k = 0; k < 10; ++k) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(0.3 * k, Eigen::Vector3d::UnitY()));
    pose.translation() << 0.1 * k, 0.2, 0.5;
    truth[k] = pose;
    if (k == 4) continue;
    result[k] = pose * Eigen::Translation3d(0.003, 0.0, 0.004) *
                Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, 3).normalized());
  }
  const PoseErrorReport report = poseError(result, truth);
  EXPECT_EQ(report.expected, 10u);
  EXPECT_EQ(report.answered, 9u);
  EXPECT_NEAR(report.position.max, 0.005, 1e-8);
  EXPECT_NEAR(report.rotation.mean, 0.02, 1e-6);
}

}  // namespace
}  // namespace softbody::evaluation
