#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "features/feature_spread.h"

namespace softbody {
namespace {

float nearest(const Eigen::Matrix3Xf& places, const std::vector<int>& taken, const Eigen::Vector3f& place) {
  float least = std::numeric_limits<float>::max();
  for (const int i : taken) least = std::min(least, (places.col(i) - place).norm());
  return least;
}

class FeatureSpread : public testing::TestWithParam<unsigned> {
 protected:
  /// Candidates on a plate; the best ones lie on its left quarter.
  Eigen::Matrix3Xf plate(int count) {
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    Eigen::Matrix3Xf places = Eigen::Matrix3Xf::Zero(3, count);
    for (int i = 0; i < count; ++i)
      places.col(i).head<2>() << (i < count / 2 ? 0.25f : 1.0f) * uniform(random_), uniform(random_);
    return places;
  }
  std::mt19937 random_{GetParam()};
};

TEST_P(FeatureSpread, NoPlaceIsFarFromOneTakenAndNoTwoAreNear) {
  const Eigen::Matrix3Xf places = plate(2000);
  const std::vector<int> taken = spreadOut(places, {}, 60, 0.0);
  ASSERT_EQ(taken.size(), 60u);
  EXPECT_TRUE(std::is_sorted(taken.begin(), taken.end()));
  float closest = 1.0f, farthest = 0.0f;
  for (std::size_t a = 0; a < taken.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b)
      closest = std::min(closest, (places.col(taken[a]) - places.col(taken[b])).norm());
  }
  for (const auto& place : places.colwise()) farthest = std::max(farthest, nearest(places, taken, place));
  // Discs of half the distance do not overlap and cover about half of the plate.
  EXPECT_GT(closest, 0.09f);
  EXPECT_LT(farthest, 1.5f * closest);
}

TEST_P(FeatureSpread, WhatIsKnownNeedsNoOther) {
  const Eigen::Matrix3Xf places = plate(1000), known = plate(2000).leftCols(1000);
  ASSERT_LE(known.row(0).maxCoeff(), 0.25f);
  for (const int i : spreadOut(places, known, 40, 0.0)) EXPECT_GT(places(0, i), 0.25f);
}

TEST_P(FeatureSpread, TakesAsManyAsAreWantedAndAllWhereNoMoreAreThere) {
  Eigen::Matrix3Xf places = plate(100);
  places.rightCols(50) = places.leftCols(50);  // corners of two scales at the same place
  for (const int wanted : {0, 1, 10, 49, 50, 51, 99, 100, 1000})
    EXPECT_EQ(spreadOut(places, places.leftCols(10), wanted, 0.0).size(), std::min<std::size_t>(wanted, 100));
  EXPECT_TRUE(spreadOut(Eigen::Matrix3Xf(3, 0), places, 5, 0.0).empty());
}

TEST_P(FeatureSpread, TheWeakFillTheGapsThatTheStrongLeave) {
  const Eigen::Matrix3Xf places = plate(4000);
  for (const int wanted : {50, 1000}) {
    const std::vector<int> taken = spreadStrong(places, wanted, 0.0);
    ASSERT_EQ(taken.size(), static_cast<std::size_t>(wanted));
    std::set<int> different(taken.begin(), taken.end());
    EXPECT_EQ(different.size(), taken.size());
    const int strong = std::max(500, wanted);
    const auto of_strong = std::count_if(taken.begin(), taken.end(), [&](int i) { return i < strong; });
    EXPECT_GE(of_strong, wanted / 2);
    // The strong ones lie on a quarter of the plate; the weak ones are spread over the rest.
    std::vector<int> others;
    std::copy_if(taken.begin(), taken.end(), std::back_inserter(others),
                 [&](int i) { return places(0, i) > 0.25f; });
    EXPECT_GT(static_cast<int>(others.size()), wanted / 5);
    for (std::size_t a = 0; a < others.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_GT((places.col(others[a]) - places.col(others[b])).norm(),
                  0.3f / std::sqrt(static_cast<float>(others.size())));
      }
    }
  }
  EXPECT_EQ(spreadStrong(places, 1, 0.0).size(), 1u);
  EXPECT_TRUE(spreadStrong(places, 0, 0.0).empty());
  EXPECT_EQ(spreadStrong(places.leftCols(30), 100, 0.0).size(), 30u);
}

TEST_P(FeatureSpread, TheWeakAreTakenInGapsOnly) {
  const Eigen::Matrix3Xf places = plate(4000);
  const double gap = 0.02;
  const std::vector<int> taken = spreadStrong(places, 1000, gap);
  ASSERT_GT(taken.size(), 700u);
  const std::vector<int> strong(taken.begin(), taken.begin() + 700);
  for (std::size_t i = strong.size(); i < taken.size(); ++i)
    EXPECT_GT(nearest(places, strong, places.col(taken[i])), gap) << i;
  EXPECT_EQ(spreadStrong(places, 1000, 2.0).size(), 700u) << "nowhere is so large a gap";
}

TEST_P(FeatureSpread, NoneIsTakenNearerThanTheGap) {
  const Eigen::Matrix3Xf places = plate(4000), known = plate(200);
  const float gap = 0.05f;
  const std::vector<int> taken = spreadOut(places, known, 1000, gap);
  ASSERT_GT(taken.size(), 50u);
  std::vector<int> all_known(200), before;
  std::iota(all_known.begin(), all_known.end(), 0);
  for (const int i : taken) {
    EXPECT_GE(nearest(known, all_known, places.col(i)), gap) << i;
    EXPECT_GE(nearest(places, before, places.col(i)), gap) << i;
    before.push_back(i);
  }
  EXPECT_TRUE(spreadOut(places, known, 1000, 2.0).empty()) << "nowhere is so large a gap";
}

INSTANTIATE_TEST_SUITE_P(Seeds, FeatureSpread, testing::Range(1u, 6u));

}  // namespace
}  // namespace softbody
