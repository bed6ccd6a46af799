#include "softbody_bringup/virtual_camera/bend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(Bend, ReachesBothDirectionsSmoothlyWithinFiveSeconds) {
  double largest = 0.0, smallest = 0.0;
  for (int frame = 0; frame < 5000; ++frame) {
    const double t = frame / 1000.0, step = bendCurvature(t + 1e-3) - bendCurvature(t);
    EXPECT_LT(std::abs(step), 0.03) << "at " << t << " s";
    if (t < 0.5) {
      EXPECT_EQ(bendCurvature(t), 0.0);
    }
    largest = std::max(largest, bendCurvature(t));
    smallest = std::min(smallest, bendCurvature(t));
  }
  EXPECT_NEAR(largest, 7.0, 1e-3);
  EXPECT_NEAR(smallest, -7.0, 1e-3);
}

}  // namespace
}  // namespace softbody::virtual_camera
