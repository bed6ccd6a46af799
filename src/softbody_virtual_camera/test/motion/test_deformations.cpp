#include "motion/deformations.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "motion/motion_profiles.h"

namespace softbody::virtual_camera {
namespace {

TEST(Bend, KeepsLengthsInTheMidPlane) {
  for (const double curvature : {-7.0, -1e-9, 0.0, 1e-5, 2.0, 7.0}) {
    double length = 0.0;
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
      const double x = -0.1 + 0.2 * i / kSteps;
      length += (bend({x + 0.2 / kSteps, 0.03, 0.0}, curvature) - bend({x, 0.03, 0.0}, curvature)).norm();
    }
    EXPECT_NEAR(length, 0.2, 1e-8) << "curvature " << curvature;
  }
}

TEST(Bend, KeepsThicknessAndGivesTheRadius) {
  for (const double curvature : {-7.0, 3.0, 7.0}) {
    for (double x = -0.1; x <= 0.1; x += 0.02) {
      const Eigen::Vector3d top = bend({x, 0.0, 0.02}, curvature), bottom = bend({x, 0.0, -0.02}, curvature);
      EXPECT_NEAR((top - bottom).norm(), 0.04, 1e-12);
      EXPECT_NEAR((top - Eigen::Vector3d(0.0, 0.0, 1.0 / curvature)).norm(), std::abs(1.0 / curvature - 0.02),
                  1e-12);
    }
  }
}

/// Determinant of the deformation gradient, by central differences.
template <typename Deformation>
double volumeRatio(const Eigen::Vector3d& place, const Deformation& deformation) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix3d gradient;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(k);
    gradient.col(k) = (deformation(place + step) - deformation(place - step)) / (2.0 * kStep);
  }
  return gradient.determinant();
}

template <typename Check>
void forPlaces(const Check& check) {
  for (double x = -0.09; x < 0.1; x += 0.03) {
    for (double y = -0.045; y < 0.05; y += 0.03) {
      for (double z = -0.02; z <= 0.02; z += 0.01) check(Eigen::Vector3d(x, y, z));
    }
  }
}

TEST(Twist, KeepsTheVolumeOfEveryPartAndTurnsByTheRate) {
  const auto deformation = [](const Eigen::Vector3d& p) { return twist(p, 7.0); };
  forPlaces([&](const Eigen::Vector3d& p) { EXPECT_NEAR(volumeRatio(p, deformation), 1.0, 1e-8); });
  const Eigen::Vector3d end = twist({0.1, 0.05, 0.0}, 7.0);
  EXPECT_NEAR(std::atan2(end.z(), end.y()), 0.7, 1e-12);
}

TEST(Stretch, ChangesTheVolumeAsThePoissonRatioSays) {
  for (const double strain : {-0.3, 0.0, 0.3}) {
    const auto half = [&](const Eigen::Vector3d& p) { return stretch(p, {strain, 0.1, 0.5}); };
    forPlaces([&](const Eigen::Vector3d& p) { EXPECT_NEAR(volumeRatio(p, half), 1.0, 1e-8); });
    const auto soft = [&](const Eigen::Vector3d& p) { return stretch(p, {strain, 0.1, 0.2}); };
    EXPECT_NEAR(volumeRatio({0.0, 0.01, 0.01}, soft), std::pow(1.0 + strain, 0.6), 1e-8);
  }
}

TEST(Stretch, HoldsOneEndAndMovesTheOtherByHalfTheStrain) {
  const Eigen::Vector3d held(-0.1, 0.03, 0.02), pulled(0.1, 0.03, 0.02);
  EXPECT_LT((stretch(held, {0.3, 0.1, 0.2}) - held).norm(), 1e-12);
  EXPECT_LT((stretch(pulled, {0.3, 0.1, 0.2}) - pulled - Eigen::Vector3d(0.03, 0.0, 0.0)).norm(), 1e-12);
}

TEST(Dent, IsDeepestAtTheContactAndNeverFolds) {
  const Dent press{{0.02, 0.0, 0.02}, -0.02, 0.018, 0.015};
  EXPECT_NEAR(dent(press.contact, press).z(), 0.005, 1e-12);
  forPlaces([&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d moved = dent(p, press);
    EXPECT_LE(p.z() - moved.z(), 0.015 + 1e-12);
    EXPECT_GE(moved.z(), -0.02 - 1e-12);
    EXPECT_GT(volumeRatio(p, [&](const Eigen::Vector3d& q) { return dent(q, press); }), 0.6);
  });
}

TEST(MotionProfiles, PlateauHoldsOneAndIsSmooth) {
  const Plateau profile{0.5, 0.75, 2.0};
  EXPECT_EQ(plateau(0.5, profile), 0.0);
  EXPECT_EQ(plateau(4.0, profile), 0.0);
  for (double t = 1.25; t <= 3.25; t += 0.1) EXPECT_NEAR(plateau(t, profile), 1.0, 1e-12);
  for (double t = 0.0; t < 5.0; t += 1e-3) {
    EXPECT_LT(std::abs(plateau(t + 1e-3, profile) - plateau(t, profile)), 2.2e-3);
  }
}

TEST(MotionProfiles, SwingReachesBothSidesSmoothlyWithinFiveSeconds) {
  double largest = 0.0, smallest = 0.0;
  for (int frame = 0; frame < 5000; ++frame) {
    const double t = frame / 1000.0, step = swing(t + 1e-3) - swing(t);
    EXPECT_LT(std::abs(step), 0.03 / 7.0) << "at " << t << " s";
    if (t < 0.5) {
      EXPECT_EQ(swing(t), 0.0);
    }
    largest = std::max(largest, swing(t));
    smallest = std::min(smallest, swing(t));
  }
  EXPECT_NEAR(largest, 1.0, 1e-4);
  EXPECT_NEAR(smallest, -1.0, 1e-4);
}

}  // namespace
}  // namespace softbody::virtual_camera
