#include <gtest/gtest.h>

#include <random>

#include "cage/half_spaces.h"

namespace softbody {
namespace {

constexpr double kTolerance = 1e-9;

std::vector<HalfSpace> randomHalfSpaces(int count, std::mt19937* random) {
  std::normal_distribution<double> normal;
  std::vector<HalfSpace> half_spaces;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d direction(normal(*random), normal(*random), normal(*random));
    half_spaces.push_back({direction.normalized(), normal(*random)});
  }
  return half_spaces;
}

double violation(const std::vector<HalfSpace>& half_spaces, const Eigen::Vector3d& x) {
  double worst = 0.0;
  for (const HalfSpace& h : half_spaces) worst = std::max(worst, h.offset - h.normal.dot(x));
  return worst;
}

/// Dykstra's alternating projections converge to the same point.
Eigen::Vector3d byProjections(const std::vector<HalfSpace>& half_spaces, Eigen::Vector3d x) {
  std::vector<Eigen::Vector3d> corrections(half_spaces.size(), Eigen::Vector3d::Zero());
  for (int iteration = 0; iteration < 20000; ++iteration) {
    for (std::size_t k = 0; k < half_spaces.size(); ++k) {
      const Eigen::Vector3d y = x + corrections[k];
      x = y + std::max(0.0, half_spaces[k].offset - half_spaces[k].normal.dot(y)) * half_spaces[k].normal;
      corrections[k] = y - x;
    }
  }
  return x;
}

TEST(HalfSpaces, NearestPointIsThatOfAlternatingProjections) {
  std::mt19937 random(1);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::vector<HalfSpace> half_spaces = randomHalfSpaces(3 + trial % 5, &random);
    const std::optional<Eigen::Vector3d> nearest = nearestPointIn(half_spaces, {0.3, -0.2, 0.1}, kTolerance);
    if (!nearest) continue;
    ++found;
    EXPECT_LE(violation(half_spaces, *nearest), kTolerance);
    const Eigen::Vector3d expected = byProjections(half_spaces, {0.3, -0.2, 0.1});
    if (violation(half_spaces, expected) < 1e-7) {
      EXPECT_LT((*nearest - expected).norm(), 1e-4);
    }
  }
  EXPECT_GT(found, 30);
}

TEST(HalfSpaces, AContradictionHasNoPoint) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_FALSE(nearestPointIn({{up, 1.0}, {-up, 1.0}}, Eigen::Vector3d::Zero(), kTolerance));
}

TEST(HalfSpaces, APointWithinStays) {
  const Eigen::Vector3d point(0.1, 0.2, 0.3);
  EXPECT_EQ(*nearestPointIn({{Eigen::Vector3d::UnitX(), 0.0}}, point, kTolerance), point);
}

}  // namespace
}  // namespace softbody
