#include "features/feature_weights.h"

#include <gtest/gtest.h>

#include <random>

namespace softbody {
namespace {

std::vector<double> weightsOf(const std::vector<double>& unexplained) {
  std::vector<FeatureMatch> matches(unexplained.size());
  for (std::size_t m = 0; m < matches.size(); ++m) matches[m].unexplained = unexplained[m];
  weighByAgreement(&matches);
  std::vector<double> weights;
  for (const FeatureMatch& match : matches) weights.push_back(match.association.weight);
  return weights;
}

/// Half-covered patches among others, in a noisy image.
TEST(FeatureWeights, AreSmallWherePatchesFitBadly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> usual(0.005, 0.02), odd(0.2, 0.45);
  std::vector<double> unexplained;
  for (int i = 0; i < 500; ++i) unexplained.push_back(i % 5 == 0 ? odd(random) : usual(random));
  const std::vector<double> weights = weightsOf(unexplained);
  for (std::size_t m = 0; m < weights.size(); ++m) {
    const bool is_odd = m % 5 == 0;
    EXPECT_TRUE(is_odd ? weights[m] < 0.05 : weights[m] > 0.5) << unexplained[m] << " " << weights[m];
  }
}

/// Noise and blur make all patches fit worse.
TEST(FeatureWeights, AreRelativeToTheFramesUsualFit) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.001, 0.1);
  std::vector<double> sharp(100), blurred(100);
  for (std::size_t m = 0; m < sharp.size(); ++m) blurred[m] = 4.0 * (sharp[m] = uniform(random));
  const std::vector<double> weights = weightsOf(sharp), same = weightsOf(blurred);
  for (std::size_t m = 0; m < weights.size(); ++m) EXPECT_NEAR(weights[m], same[m], 1e-12);
}

TEST(FeatureWeights, AreWholeWherePatchesFitExactly) {
  EXPECT_TRUE(weightsOf({}).empty());
  EXPECT_EQ(weightsOf({0.0, 0.0, 0.0}), std::vector<double>(3, 1.0));
}

MapFeature featureWith(double place_deviation_m, double expected_s, double found_s) {
  MapFeature feature;
  feature.place_variance = place_deviation_m * place_deviation_m;
  feature.expected_s = expected_s;
  feature.found_s = found_s;
  return feature;
}

TEST(FeatureTrust, IsFullForANewFeatureOnAKnownSurface) {
  EXPECT_DOUBLE_EQ(trustIn(featureWith(0.0, 0, 0)), 1.0);
  EXPECT_DOUBLE_EQ(trustIn(featureWith(0.0, 50, 50)), 1.0);
}

/// Independent errors add up: with 1 mm of its own and 3 mm of its place, a match has a tenth of the weight.
TEST(FeatureTrust, FallsWithTheVarianceOfItsPlace) {
  EXPECT_NEAR(trustIn(featureWith(0.003, 0, 0)), 0.1, 1e-12);
  for (const double deviation : {0.0, 0.0005, 0.002, 0.01})
    EXPECT_GT(trustIn(featureWith(deviation, 9, 5)), trustIn(featureWith(2.0 * deviation + 1e-4, 9, 5)));
}

TEST(FeatureTrust, TendsToTheShareOfTimeThatShowedIt) {
  EXPECT_NEAR(trustIn(featureWith(0.0, 100000, 20000)), 0.2, 1e-4);
  for (int expected = 1; expected < 40; ++expected)
    for (int found = 0; found < expected; ++found)
      EXPECT_LT(trustIn(featureWith(0.0, expected, found)), trustIn(featureWith(0.0, expected, found + 1)));
}

}  // namespace
}  // namespace softbody
