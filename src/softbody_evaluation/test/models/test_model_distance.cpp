#include "softbody_evaluation/models/model_distance.h"

#include <test_support/gtest.h>

#include <nlohmann/json.hpp>
#include "fixtures/round_bodies.h"
#include "report/model_report.h"

namespace softbody::evaluation {
namespace {

const Eigen::Isometry3d kHere = Eigen::Isometry3d::Identity();

ModelReport measured(const Model& scanned, const Model& truth) {
  return compareModels(scanned, truth, kHere, 1);
}

TEST(ModelDistance, AModelIsAtDistanceZeroFromItself) {
  const ModelReport report = measured(potato(), potato());
  EXPECT_LT(report.whole.to_truth.max, 1e-9);
  EXPECT_LT(report.whole.to_scanned.max, 1e-9);
  EXPECT_DOUBLE_EQ(report.whole.within_1mm, 1.0);
  ASSERT_TRUE(report.scanned_m3 && report.true_m3);
  EXPECT_DOUBLE_EQ(*report.scanned_m3, *report.true_m3);
  EXPECT_FALSE(report.seen);
  EXPECT_EQ(report.color.count, 0u);
}

TEST(ModelDistance, AnInflatedBallIsOffByWhatItWasInflatedBy) {
  const ModelReport report = measured(ball(0.0515), ball(0.05));
  const double facets = 0.05 * (1.0 - std::cos(M_PI / 40.0));  // between a chord and its arc
  EXPECT_NEAR(report.whole.to_truth.mean, 0.0015, facets);
  EXPECT_NEAR(report.whole.to_scanned.p99, 0.0015, facets);
  EXPECT_LE(report.whole.to_truth.p99, report.whole.to_truth.max);
  EXPECT_DOUBLE_EQ(report.whole.within_1mm, 0.0);
  EXPECT_DOUBLE_EQ(report.whole.within_2mm, 1.0);
  EXPECT_NEAR(*report.scanned_m3 / *report.true_m3, std::pow(0.0515 / 0.05, 3), 1e-9);
  EXPECT_NEAR(*report.true_m3, 4.0 / 3.0 * M_PI * std::pow(0.05, 3), 0.01 * *report.true_m3);
}

TEST(ModelDistance, HalfASurfaceIsHalfComplete) {
  const Model half = part(ball(0.05), [](const Eigen::Vector3d& p) { return p.z() > 0.0; });
  const ModelReport report = measured(half, ball(0.05));
  EXPECT_LT(report.whole.to_truth.max, 1e-9);
  // A ring of 2 mm below the edge is near enough; on a ball, areas go with heights.
  EXPECT_NEAR(report.whole.within_2mm, 0.5 * (1.0 + 0.002 / 0.05), 0.005);
  EXPECT_FALSE(report.scanned_m3);
  EXPECT_TRUE(report.true_m3);
  EXPECT_TRUE(toJson(report)["scanned_ml"].is_null());
  EXPECT_TRUE(says(toText(report), "not closed"));
}

TEST(ModelDistance, WhatWasNeverSeenCountsApart) {
  Model scanned = ball(0.05);
  for (auto row : scanned.mesh.vertices.rowwise()) {
    scanned.seen.push_back(row.z() > -0.02 ? 1.0f : 0.0f);
    if (row.z() < -0.02) row.z() = -0.02;  // a flat bottom
  }
  const ModelReport report = measured(scanned, ball(0.05));
  ASSERT_TRUE(report.seen && report.unseen);
  EXPECT_LT(report.seen->to_truth.p95, 0.001);
  EXPECT_GT(report.unseen->to_truth.mean, 0.01);
  EXPECT_NEAR(report.seen->share + report.unseen->share, 1.0, 1e-12);
  EXPECT_GT(report.seen->within_2mm, 0.99);
  EXPECT_LT(report.unseen->within_2mm, 0.1);
}

/// One picture in four colours, seen through texture coordinates that follow x and y.
Model painted(Model model, double gain) {
  cv::Mat3b picture(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x)
      picture(y, x) = cv::Vec3b(cv::saturate_cast<uchar>(gain * (40 + 2 * x)),
                                cv::saturate_cast<uchar>(gain * (40 + 2 * y)), 100);
  }
  model.pictures = {picture};
  model.picture.assign(static_cast<std::size_t>(model.mesh.triangles.rows()), 0);
  model.texture_coordinates.resize(3 * model.mesh.triangles.rows(), 3);
  for (Eigen::Index i = 0; i < model.texture_coordinates.rows(); ++i) {
    const Eigen::RowVector3d p = model.mesh.vertices.row(model.mesh.triangles(i / 3, i % 3));
    model.texture_coordinates.row(i) << 0.5 + p.x() / 0.2, 0.5 + p.y() / 0.2, 0.0;
  }
  return model;
}

TEST(ModelDistance, ColoursAreComparedAfterAGain) {
  const ModelReport same = measured(painted(potato(), 1.0), painted(potato(), 1.0));
  EXPECT_LT(same.color.mean, 1e-6);
  const ModelReport brighter = measured(painted(potato(), 1.2), painted(potato(), 1.0));
  EXPECT_NEAR(brighter.gain[0], 1.2, 0.01);
  EXPECT_NEAR(brighter.gain[2], 1.0, 1e-6);
  EXPECT_LT(brighter.color.mean, 0.5);  // rounding
  Model shifted = painted(potato(), 1.0);
  shifted.pictures[0] = shifted.pictures[0] + cv::Scalar(0, 0, 30);  // red is constant: a gain explains it
  cv::flip(shifted.pictures[0], shifted.pictures[0], 1);
  EXPECT_GT(measured(shifted, painted(potato(), 1.0)).color.mean, 5.0);
}

TEST(ModelDistance, TheSameSeedGivesTheSameMetrics) {
  const auto mean = [](std::uint64_t seed) {
    return compareModels(ball(0.051), potato(), kHere, seed).whole.to_truth.mean;
  };
  EXPECT_EQ(mean(1), mean(1));
  EXPECT_NE(mean(1), mean(2));
}

}  // namespace
}  // namespace softbody::evaluation
