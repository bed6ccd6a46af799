#include "prediction/tracking_signal.h"

#include <gtest/gtest.h>

#include <random>

namespace softbody {
namespace {

constexpr double kFrameInterval = 1.0 / 30.0;  // [s]
constexpr Eigen::Index kVertices = 200;

/// Corrections without a common direction [m].
Points noiseOf(double deviation, std::mt19937* random) {
  std::normal_distribution<double> noise(0.0, deviation);
  return Points::NullaryExpr(kVertices, 3, [&] { return noise(*random); });
}

double meanGain(const TrackingSignal& signal) {
  double sum = 0.0;
  for (Eigen::Index v = 0; v < kVertices; ++v) sum += signal.gain(v);
  return sum / kVertices;
}

TEST(TrackingSignal, FollowsEverythingUntilItKnows) {
  std::mt19937 random(1);
  TrackingSignal signal;
  EXPECT_EQ(signal.gain(0), 1.0);
  signal.observe(noiseOf(1e-3, &random), kFrameInterval);
  EXPECT_EQ(meanGain(signal), 1.0);
}

TEST(TrackingSignal, RandomCorrectionsAreNoise) {
  std::mt19937 random(2);
  TrackingSignal signal;
  for (int i = 0; i < 60; ++i) signal.observe(noiseOf(1e-3, &random), kFrameInterval);
  EXPECT_LT(meanGain(signal), 0.2);
}

TEST(TrackingSignal, PersistentCorrectionsAreMotion) {
  std::mt19937 random(3);
  const Points motion = Points::Constant(kVertices, 3, 1e-3);
  TrackingSignal still, noisy;
  for (int i = 0; i < 60; ++i) {
    noisy.observe(noiseOf(1e-3, &random), kFrameInterval);
    still.observe(Points::Zero(kVertices, 3), kFrameInterval);
  }
  for (int i = 0; i < 2; ++i) still.observe(motion, kFrameInterval);
  EXPECT_GT(meanGain(still), 0.7) << "without noise, motion is known by two corrections";
  for (int i = 0; i < 15; ++i) noisy.observe(motion + noiseOf(2e-4, &random), kFrameInterval);
  EXPECT_GT(meanGain(noisy), 0.85);
  for (int i = 0; i < 60; ++i) noisy.observe(noiseOf(1e-3, &random), kFrameInterval);
  EXPECT_LT(meanGain(noisy), 0.2) << "it ends with the motion";
}

/// A body that swings is slowed down before it turns back: the corrections change their sign slowly.
TEST(TrackingSignal, MotionThatTurnsBackIsFollowedThroughout) {
  std::mt19937 random(6);
  TrackingSignal signal;
  double least = 1.0;
  for (int i = 0; i < 60; ++i) {
    const Points motion = Points::Constant(kVertices, 3, 1e-3 * std::cos(2.0 * M_PI * i / 15.0));
    signal.observe(motion + noiseOf(2e-5, &random), kFrameInterval);
    if (i > 5) least = std::min(least, meanGain(signal));
  }
  EXPECT_GT(least, 0.9);
}

TEST(TrackingSignal, VerticesHaveTheirOwn) {
  std::mt19937 random(4);
  TrackingSignal signal;
  for (int i = 0; i < 60; ++i) {
    Points corrections = noiseOf(1e-3, &random);
    corrections.row(7) = Eigen::RowVector3d(0.0, 2e-3, 0.0);
    signal.observe(corrections, kFrameInterval);
  }
  EXPECT_NEAR(signal.gain(7), 1.0, 1e-5);
  EXPECT_LT(meanGain(signal), 0.2);
}

/// Only directions and ratios count, not the unit.
TEST(TrackingSignal, TheScaleOfTheCorrectionsDoesNotCount) {
  std::mt19937 random(5);
  TrackingSignal small, large;
  for (int i = 0; i < 20; ++i) {
    const Points corrections = noiseOf(1e-3, &random) + Points::Constant(kVertices, 3, 5e-4);
    small.observe(corrections, kFrameInterval);
    large.observe(1000.0 * corrections, kFrameInterval);
    for (Eigen::Index v = 0; v < kVertices; ++v) {
      EXPECT_NEAR(small.gain(v), large.gain(v), 1e-12);
      EXPECT_GT(small.gain(v), 0.0) << "no error may last";
      EXPECT_LE(small.gain(v), 1.0);
    }
  }
}

TEST(TrackingSignal, ResetForgets) {
  std::mt19937 random(6);
  TrackingSignal signal;
  for (int i = 0; i < 20; ++i) signal.observe(noiseOf(1e-3, &random), kFrameInterval);
  signal.reset();
  EXPECT_EQ(meanGain(signal), 1.0);
  signal.observe(Points::Zero(3, 3), kFrameInterval);
  EXPECT_EQ(signal.gain(2), 1.0) << "a body with another number of vertices";
}

}  // namespace
}  // namespace softbody
