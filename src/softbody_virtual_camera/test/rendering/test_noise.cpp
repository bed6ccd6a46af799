#include "softbody_virtual_camera/rendering/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kFx = 615.0;

struct Temporal {
  double mean = 0.0, deviation = 0.0;  ///< over time, averaged over the pixels [m]
};

/// Of a wall at z, whole millimetres as in a bag.
Temporal temporalNoise(const DepthNoise& noise, double z) {
  constexpr int kFrames = 80;
  cv::Mat1d sum = cv::Mat1d::zeros(60, 80), squares = sum.clone(), count = sum.clone();
  for (int frame = 0; frame < kFrames; ++frame) {
    cv::Mat1f depth(60, 80, static_cast<float>(z));
    noise.apply(frame, kFx, &depth);
    const cv::Mat1w millimetres = toMillimetres(depth);
    for (int i = 0; i < static_cast<int>(depth.total()); ++i) {
      const double error = 1e-3 * millimetres(i / 80, i % 80) - z;
      if (millimetres(i / 80, i % 80) == 0) continue;
      sum(i / 80, i % 80) += error;
      squares(i / 80, i % 80) += error * error;
      count(i / 80, i % 80) += 1.0;
    }
  }
  const cv::Mat1d mean = sum / count;
  const cv::Mat1d variance = squares / count - mean.mul(mean);
  return {cv::mean(mean)[0], std::sqrt(cv::mean(variance)[0])};
}

TEST(DepthNoise, IsOneToTwoMillimetresAtHalfAMetreAndUnbiased) {
  const Temporal noise = temporalNoise(DepthNoise({}, 7), 0.5);
  EXPECT_GE(noise.deviation, 0.8e-3);
  EXPECT_LE(noise.deviation, 2.0e-3);
  const double expected =
      0.5 * 0.5 / (425.0 * 0.050) * 0.1;  // z^2 / (focal baseline) times the disparity's deviation
  EXPECT_NEAR(noise.deviation, expected, 0.1e-3);
  EXPECT_NEAR(noise.mean, 0.0, 0.1e-3);
}

TEST(DepthNoise, GrowsWithTheSquareOfTheDistance) {
  const DepthNoise noise({}, 7);
  EXPECT_NEAR(temporalNoise(noise, 1.6).deviation / temporalNoise(noise, 0.8).deviation, 4.0, 0.4);
}

TEST(DepthNoise, IsCorrelatedOverAFewPixelsOnly) {
  cv::Mat1f depth(480, 640, 0.5f);
  DepthNoiseOptions options;
  options.holes = options.quantization = false;
  DepthNoise(options, 5).apply(0, kFx, &depth);
  const cv::Mat1f error = depth - 0.5f;
  const auto correlation = [&](int distance) {
    const cv::Mat1f a = error.colRange(0, 600), b = error.colRange(distance, 600 + distance);
    return a.dot(b) / a.dot(a);
  };
  EXPECT_GT(correlation(1), 0.5);
  EXPECT_LT(std::abs(correlation(10)), 0.05);
}

TEST(DepthNoise, EveryPartCanBeSwitchedOff) {
  cv::Mat1f depth(120, 160, 0.9f);
  depth(cv::Rect(60, 40, 40, 40)).setTo(0.5f);
  cv::Mat1f untouched = depth.clone();
  DepthNoise(noNoise().depth, 1).apply(3, kFx, &untouched);
  EXPECT_EQ(cv::norm(depth, untouched, cv::NORM_INF), 0.0);
}

TEST(DepthNoise, WhatOnlyOneImagerSeesIsLeftOfNearObjects) {
  cv::Mat1f depth(120, 200, 1.0f);
  depth(cv::Rect(100, 0, 60, 120)).setTo(0.5f);
  DepthNoiseOptions options = noNoise().depth;
  options.edge_dropouts = true;
  options.edge_share = 1e-9;
  DepthNoise(options, 1).apply(0, kFx, &depth);
  const int shadow = static_cast<int>(kFx * options.baseline_m * (1.0 / 0.5 - 1.0 / 1.0));
  for (int v = 0; v < 120; ++v) {
    EXPECT_EQ(cv::countNonZero(depth.row(v).colRange(100 - shadow + 1, 100)), 0);
    EXPECT_EQ(cv::countNonZero(depth.row(v).colRange(0, 99 - shadow)), 99 - shadow);
    EXPECT_EQ(cv::countNonZero(depth.row(v).colRange(100, 200)), 100);
  }
}

TEST(DepthNoise, HolesAreSmallAndRare) {
  cv::Mat1f depth(480, 640, 0.5f);
  DepthNoise({}, 9).apply(0, kFx, &depth);
  const double share = 1.0 - cv::countNonZero(depth) / static_cast<double>(depth.total());
  EXPECT_GT(share, 0.0);
  EXPECT_LT(share, 0.005);
}

TEST(ColorNoise, HasTheStatedDeviationAndNoBias) {
  cv::Mat3b color(480, 640, cv::Vec3b(128, 128, 128));
  ColorNoise({}, 11).apply(0, &color);
  cv::Scalar mean, deviation;
  cv::meanStdDev(color, mean, deviation);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[k], 128.0, 0.05);
    EXPECT_NEAR(deviation[k], 2.1, 0.1);
  }
}

TEST(Noise, DependsOnSeedAndFrameAndOnNothingElse) {
  const auto noisy = [](std::uint64_t seed, int frame) {
    cv::Mat1f depth(48, 64, 0.5f);
    DepthNoise({}, seed).apply(frame, kFx, &depth);
    return depth;
  };
  EXPECT_EQ(cv::norm(noisy(1, 2), noisy(1, 2), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(noisy(1, 2), noisy(2, 2), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(noisy(1, 2), noisy(1, 3), cv::NORM_INF), 0.0);
}

TEST(ToMillimetres, RoundsAndGivesZeroForNothing) {
  const cv::Mat1f depth = (cv::Mat1f(1, 5) << 0.0f, 0.4996f, 0.5004f, 70.0f, -1.0f);
  const cv::Mat1w expected = (cv::Mat1w(1, 5) << 0, 500, 500, 0, 0);
  EXPECT_EQ(cv::norm(toMillimetres(depth), expected, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace softbody::virtual_camera
