#include "outline/contour_posterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace softbody {
namespace {

constexpr int kReach = 16;          // [px] each way
constexpr double kSure = 3.0;       // log odds of a pixel that shows clearly what it is
constexpr double kPredicted = 1.0;  // variance of the prediction [px^2]

ContourPosterior posterior(const std::vector<LinePixel>& line) { return contourPosterior(line, kPredicted); }

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
    const ContourPosterior found = posterior(lineWithEndAt(end));
    EXPECT_FALSE(found.beyond);
    EXPECT_NEAR(found.end.mean, end, 0.1);
    EXPECT_LT(found.end.variance, 2.0);
  }
}

/// Pixels far from the end of the body say nothing about where exactly it is.
TEST(ContourPosterior, MovesWithTheLine) {
  const ContourPosterior at_zero = posterior(lineWithEndAt(0.0));
  for (const double shift : {-5.3, -0.25, 0.4, 3.7}) {
    const ContourPosterior moved = posterior(lineWithEndAt(shift, kSure, shift));
    EXPECT_NEAR(moved.end.mean, at_zero.end.mean + shift, 1e-3);
    EXPECT_NEAR(moved.end.variance, at_zero.end.variance, 1e-3);
  }
}

/// The log odds are constant up to a pixel before the end, where they are zero. Half of them is independent.
TEST(ContourPosterior, DoubtGrowsWithDistanceAndWithWhatThePixelsKnow) {
  EXPECT_NEAR(posterior(lineWithEndAt(0.0)).doubt, 0.0, 0.1);
  for (const double log_odds : {0.5, 1.0, 3.0}) {
    for (const double end : {-9.0, -4.0, 4.0, 9.0}) {
      const double ratio = 0.5 * log_odds * (std::abs(end) - 0.5);
      EXPECT_NEAR(posterior(lineWithEndAt(end, log_odds)).doubt, std::sqrt(2.0 * ratio), 1e-6);
    }
  }
  EXPECT_EQ(posterior(lineWithEndAt(0.0, 0.0)).doubt, 0.0);
}

TEST(ContourPosterior, BothSidesCountEqually) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int i = 0; i < 50; ++i) {
    std::vector<LinePixel> line = lineWithEndAt(2.2), mirrored;
    for (LinePixel& pixel : line) pixel.log_odds += noise(random);
    for (auto pixel = line.rbegin(); pixel != line.rend(); ++pixel)
      mirrored.push_back({-pixel->distance, -pixel->log_odds});
    const ContourPosterior found = posterior(line), other = posterior(mirrored);
    EXPECT_NEAR(found.end.mean, -other.end.mean, 1e-9);
    EXPECT_NEAR(found.end.variance, other.end.variance, 1e-9);
    EXPECT_EQ(found.beyond, other.beyond);
  }
}

TEST(ContourPosterior, WeakerEvidenceGivesALargerVariance) {
  double last = 0.0;
  for (const double log_odds : {3.0, 1.0, 0.5, 0.2}) {
    const double variance = posterior(lineWithEndAt(0.3, log_odds)).end.variance;
    EXPECT_GT(variance, last);
    last = variance;
  }
}

/// Without evidence every end on the line is equally probable.
TEST(ContourPosterior, NoEvidenceGivesTheVarianceOfTheWholeLine) {
  const ContourPosterior found = posterior(lineWithEndAt(0.0, 0.0));
  EXPECT_NEAR(found.end.mean, 0.0, 1e-9);
  EXPECT_NEAR(found.end.variance, 4.0 * kReach * kReach / 12.0, 2.0);
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
    const ContourPosterior found = posterior(line);
    sum += found.end.mean - truth;
    squares += (found.end.mean - truth) * (found.end.mean - truth);
    variance += found.end.variance;
  }
  EXPECT_NEAR(sum / kLines, 0.0, 0.15);
  EXPECT_GT(variance / squares, 0.5);
  EXPECT_LT(variance / squares, 2.0);
}

TEST(ContourPosterior, AnEndOutsideOfTheLineIsBeyond) {
  EXPECT_TRUE(posterior(lineWithEndAt(2.0 * kReach)).beyond) << "the body everywhere";
  EXPECT_TRUE(posterior(lineWithEndAt(-2.0 * kReach)).beyond) << "the body nowhere";
  EXPECT_FALSE(posterior(lineWithEndAt(kReach - 4.0)).beyond);
}

/// Log odds that fall linearly make the likelihood of the end a normal distribution. The prediction then does
/// not matter for what the line adds.
TEST(ContourPosterior, ANormalLikelihoodIsAddedAsItIs) {
  for (const double mean : {-1.5, 0.0, 0.8}) {
    for (const double variance : {0.5, 2.0, 6.0}) {
      std::vector<LinePixel> line;
      for (int step = -kReach; step <= kReach; ++step)
        line.push_back({1.0 * step, -2.0 * (step - mean) / variance});
      for (const double predicted : {0.5, 2.0, 8.0}) {
        const ContourEnd added = contourPosterior(line, predicted).added;
        EXPECT_NEAR(added.mean, mean, 0.02);
        EXPECT_NEAR(added.variance, variance + 1.0 / 12.0, 0.1);
      }
    }
  }
}

TEST(ContourPosterior, ALineThatSaysNothingAddsNothing) {
  for (const double predicted : {0.5, 4.0, 100.0})
    EXPECT_TRUE(std::isinf(contourPosterior(lineWithEndAt(0.0, 0.0), predicted).added.variance));
}

/// The body may end at -11, or at 0.2 after something else that begins there.
TEST(ContourPosterior, OfTwoEndsTheOneNearThePredictionIsAdded) {
  std::vector<LinePixel> line = lineWithEndAt(0.2);
  for (LinePixel& pixel : line)
    if (std::abs(pixel.distance + 9.0) < 2.5) pixel.log_odds = -2.0 * kSure;
  const ContourPosterior found = posterior(line);
  EXPECT_LT(found.end.mean, -5.0);
  EXPECT_NEAR(found.together, 0.2, 0.3);
  EXPECT_NEAR(found.added.mean, 0.2, 0.5);
}

TEST(ContourPosterior, ThePredictionIsAsUncertainAsSuddenMotions) {
  EXPECT_TRUE(std::isinf(predictionVariance(0.0))) << "nothing is known of it";
  for (const double error : {0.5, 2.0, 10.0}) EXPECT_GT(predictionVariance(error), error * error);
}

}  // namespace
}  // namespace softbody
