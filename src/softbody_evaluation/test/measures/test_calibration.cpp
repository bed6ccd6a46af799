#include "softbody_evaluation/measures/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace softbody::evaluation {
namespace {

/// Distances of errors with three independent normal components, and the predicted deviation times a factor.
FrameVertexError drawnFrame(int count, double factor, std::mt19937* random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-4.0, -2.0);
  FrameVertexError frame;
  for (int i = 0; i < count; ++i) {
    const double rms = std::pow(10.0, exponent(*random)), component = rms / std::sqrt(3.0);
    const auto draw = [&] { return component * normal(*random); };
    const Eigen::Vector3d error(draw(), draw(), draw());
    (i % 2 == 0 ? frame.visible : frame.hidden).push_back(static_cast<float>(error.norm()));
    (i % 2 == 0 ? frame.visible_deviations : frame.hidden_deviations)
        .push_back(static_cast<float>(factor * rms));
  }
  return frame;
}

TEST(Calibration, NinetyPercentAreWithinTheBoundOfTrueDeviations) {
  std::mt19937 random(4);
  const auto report = calibration({drawnFrame(40000, 1.0, &random), drawnFrame(40000, 1.0, &random)});
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->within_visible, 0.9, 0.006);
  EXPECT_NEAR(report->within_hidden, 0.9, 0.006);
  EXPECT_NEAR(report->median_ratio, std::sqrt(6.2514 / 2.3660), 0.02);  // quantiles of chi square, 3 degrees
  std::size_t count = 0;
  double last = 0.0;
  for (const CalibrationBin& bin : report->bins) {
    EXPECT_GT(bin.predicted_rms, last);
    if (bin.count > 1000) {
      EXPECT_NEAR(bin.error_rms / bin.predicted_rms, 1.0, 0.06);
    }
    last = bin.predicted_rms;
    count += bin.count;
  }
  EXPECT_EQ(count, 80000u);
}

TEST(Calibration, TooSmallDeviationsLeaveVerticesOut) {
  std::mt19937 random(5);
  const auto report = calibration({drawnFrame(20000, 0.5, &random)});
  EXPECT_LT(report->within_visible, 0.5);
  for (const CalibrationBin& bin : report->bins) {
    if (bin.count > 1000) {
      EXPECT_NEAR(bin.error_rms / bin.predicted_rms, 2.0, 0.15);
    }
  }
}

TEST(Calibration, IsAbsentWithoutDeviationsAndTakesThemByVertex) {
  MeshState truth, result;
  truth.vertices = result.vertices = Points::Zero(3, 3);
  truth.confidence = {1.0f, 0.0f, 1.0f};
  result.vertices.col(0) << 1e-3, 2e-3, 3e-3;
  EXPECT_FALSE(calibration({vertexError(result, truth, {0, 1, 2})}));
  result.standard_deviation = {1e-3f, 1e-3f, 1e-3f};
  const auto report = calibration({vertexError(result, truth, {0, 1, 2})});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->within_visible, 0.5);
  EXPECT_EQ(report->within_hidden, 0.0);
  ASSERT_EQ(report->bins.size(), 1u);
  EXPECT_NEAR(report->bins[0].error_rms, std::sqrt(14.0 / 3.0) * 1e-3, 1e-9);
}

TEST(FrameParts, AreThoseOfTheVisibleHiddenAndCoveredVertices) {
  MeshState truth, result;
  truth.vertices = result.vertices = Points::Zero(3, 3);
  truth.confidence = {1.0f, 0.0f, 1.0f};
  result.vertices.col(0) << 1e-3, 2e-3, 3e-3;
  VertexGroups groups;
  groups.seen_at_first = {true, true, true};
  const VertexErrorReport report = summarize({vertexError(result, truth, {0, 1, 2}, groups)});
  EXPECT_NEAR(report.frame_visible_means.at(0), 2e-3, 1e-9);
  EXPECT_NEAR(report.frame_visible_largest.at(0), 3e-3, 1e-9);
  EXPECT_NEAR(report.frame_hidden_means.at(0), 2e-3, 1e-9);
  EXPECT_NEAR(report.frame_covered_means.at(0), 2e-3, 1e-9);
  truth.confidence = {1.0f, 1.0f, 1.0f};
  EXPECT_TRUE(std::isnan(summarize({vertexError(result, truth, {0, 1, 2})}).frame_hidden_means.at(0)));
}

}  // namespace
}  // namespace softbody::evaluation
