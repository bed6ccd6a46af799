#include "outline/contour_posterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace softbody {
namespace {

constexpr int kReach = 16;     // [px] each way
constexpr double kSure = 3.0;  // log odds of a pixel that shows clearly what it is

/// A line whose pixels are the body up to an end. The pixel at the end is blended by its covered share.
/// @param offset of the pixels' centres from whole distances [px].
std::vector<LinePixel> lineWithEndAt(double end, double log_odds = kSure, double offset = 0.0) {
  std::vector<LinePixel> line;
  for (int step = -kReach; step <= kReach; ++step) {
    const double distance = step + offset;
    const double covered = std::clamp(end - distance + 0.5, 0.0, 1.0);
    line.push_back({distance, log_odds * (2.0 * covered - 1.0)});
  }
  return line;
}

TEST(ContourPosterior, FindsAStepBetweenThePixels) {
  for (double end = -8.0; end <= 8.0; end += 0.1) {
    const ContourPosterior found = contourPosterior(lineWithEndAt(end));
    EXPECT_FALSE(found.beyond);
    EXPECT_NEAR(found.mean, end, 0.1);
    EXPECT_LT(found.variance, 2.0);
  }
}

/// Pixels far from the end of the body say nothing about where exactly it is.
TEST(ContourPosterior, MovesWithTheLine) {
  const ContourPosterior at_zero = contourPosterior(lineWithEndAt(0.0));
  for (const double shift : {-5.3, -0.25, 0.4, 3.7}) {
    const ContourPosterior moved = contourPosterior(lineWithEndAt(shift, kSure, shift));
    EXPECT_NEAR(moved.mean, at_zero.mean + shift, 1e-3);
    EXPECT_NEAR(moved.variance, at_zero.variance, 1e-3);
  }
}

/// The log odds are constant up to a pixel before the end, where they are zero. Half of them is independent.
TEST(ContourPosterior, DoubtGrowsWithDistanceAndWithWhatThePixelsKnow) {
  EXPECT_NEAR(contourPosterior(lineWithEndAt(0.0)).doubt, 0.0, 0.1);
  for (const double log_odds : {0.5, 1.0, 3.0}) {
    for (const double end : {-9.0, -4.0, 4.0, 9.0}) {
      const double ratio = 0.5 * log_odds * (std::abs(end) - 0.5);
      EXPECT_NEAR(contourPosterior(lineWithEndAt(end, log_odds)).doubt, std::sqrt(2.0 * ratio), 1e-6);
    }
  }
  EXPECT_EQ(contourPosterior(lineWithEndAt(0.0, 0.0)).doubt, 0.0);
}

TEST(ContourPosterior, BothSidesCountEqually) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int i = 0; i < 50; ++i) {
    std::vector<LinePixel> line = lineWithEndAt(2.2), mirrored;
    for (LinePixel& pixel : line) pixel.log_odds += noise(random);
    for (auto pixel = line.rbegin(); pixel != line.rend(); ++pixel)
      mirrored.push_back({-pixel->distance, -pixel->log_odds});
    const ContourPosterior found = contourPosterior(line), other = contourPosterior(mirrored);
    EXPECT_NEAR(found.mean, -other.mean, 1e-9);
    EXPECT_NEAR(found.variance, other.variance, 1e-9);
    EXPECT_EQ(found.beyond, other.beyond);
  }
}

TEST(ContourPosterior, WeakerEvidenceGivesALargerVariance) {
  double last = 0.0;
  for (const double log_odds : {3.0, 1.0, 0.5, 0.2}) {
    const double variance = contourPosterior(lineWithEndAt(0.3, log_odds)).variance;
    EXPECT_GT(variance, last);
    last = variance;
  }
}

/// Without evidence every end on the line is equally probable.
TEST(ContourPosterior, NoEvidenceGivesTheVarianceOfTheWholeLine) {
  const ContourPosterior found = contourPosterior(lineWithEndAt(0.0, 0.0));
  EXPECT_NEAR(found.mean, 0.0, 1e-9);
  EXPECT_NEAR(found.variance, 4.0 * kReach * kReach / 12.0, 2.0);
}

/// On average over many noisy lines the mean is right, and its error is about as large as the variance says.
TEST(ContourPosterior, TheErrorIsAsLargeAsTheVarianceSays) {
  constexpr int kLines = 2000;
  constexpr double kLogOdds = 0.8;
  // The log odds of a measurement with normal noise have the mean +-L and the variance 2 L. Pairs of pixels
  // share their noise, as after a blur.
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, std::sqrt(2.0 * kLogOdds));
  std::uniform_real_distribution<double> end(-3.0, 3.0);
  double sum = 0.0, squares = 0.0, variance = 0.0;
  for (int i = 0; i < kLines; ++i) {
    const double truth = end(random);
    std::vector<LinePixel> line = lineWithEndAt(truth, kLogOdds);
    double shared = noise(random);
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (k % 2 == static_cast<std::size_t>(i) % 2) shared = noise(random);
      line[k].log_odds += shared;
    }
    const ContourPosterior found = contourPosterior(line);
    sum += found.mean - truth;
    squares += (found.mean - truth) * (found.mean - truth);
    variance += found.variance;
  }
  EXPECT_NEAR(sum / kLines, 0.0, 0.15);
  EXPECT_GT(variance / squares, 0.5);
  EXPECT_LT(variance / squares, 2.0);
}

TEST(ContourPosterior, AnEndOutsideOfTheLineIsBeyond) {
  EXPECT_TRUE(contourPosterior(lineWithEndAt(2.0 * kReach)).beyond) << "the body everywhere";
  EXPECT_TRUE(contourPosterior(lineWithEndAt(-2.0 * kReach)).beyond) << "the body nowhere";
  EXPECT_FALSE(contourPosterior(lineWithEndAt(kReach - 4.0)).beyond);
}

}  // namespace
}  // namespace softbody
