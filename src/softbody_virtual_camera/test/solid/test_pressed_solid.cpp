#include <gtest/gtest.h>

#include "fixtures/scene_fixtures.h"
#include "fixtures/solid_fixtures.h"
#include "solid/pressed_solid.h"

namespace softbody::virtual_camera {
namespace {

const PressedSolid::Stamp kAll{Eigen::Vector2d::Zero(), 0.2}, kMiddle{Eigen::Vector2d(0.02, 0.0), 0.03};

TEST(PressedSolid, StampAndTableAreInBalance) {
  const HexSolid solid = solidOf(bar(), 0.01);
  PressedSolid pressed(solid, bar(), kMiddle, kModulus_pa);
  double last = pressed.shape().stamp_m;
  EXPECT_NEAR(last, 0.02, 1e-12);
  for (const double force : {0.2, 1.0, 3.0, 6.0}) {
    const PressedShape shape = pressed.press(force);
    EXPECT_NEAR(shape.stamp.force.z(), -force, 1e-5);
    EXPECT_LT((shape.stamp.force + shape.table.force).norm(), 1e-5);
    // No torque about the middle of the table.
    EXPECT_NEAR(shape.stamp.place.x(), shape.table.place.x(), 1e-3);
    EXPECT_NEAR(shape.stamp.place.y(), shape.table.place.y(), 1e-3);
    EXPECT_LT(shape.stamp_m, last);
    last = shape.stamp_m;
  }
  EXPECT_LT(last, 0.02 - 2e-3);
}

TEST(PressedSolid, ABlockIsPressedAsTheorySays) {
  constexpr double kForce = 0.4;  // [N]
  const TriangleMesh column = box({0.02, 0.02, 0.1});
  const HexSolid solid = solidOf(column, 0.01, 0.0);
  PressedSolid pressed(solid, column, kAll, kModulus_pa);
  const double strain = kForce / (kModulus_pa * 0.02 * 0.02);
  const double sunk = 2.0 * 1e-4 * strain;
  EXPECT_NEAR(0.05 - pressed.press(kForce).stamp_m, 0.1 * strain + sunk, 0.04 * 0.1 * strain);
}

TEST(PressedSolid, IsRepeatable) {
  const HexSolid solid = solidOf(bar(), 0.02);
  PressedSolid first(solid, bar(), kMiddle, kModulus_pa), second(solid, bar(), kMiddle, kModulus_pa);
  EXPECT_EQ(first.press(2.0).nodes, second.press(2.0).nodes);
}

TEST(PressedSolid, SamplesHaveTheSurfacesArea) {
  double up = 0.0, all = 0.0;
  for (const SurfaceSample& sample : samplesOf(bar(), fillWithCells(bar(), 0.01), 3e-3)) {
    all += sample.area_m2;
    if (sample.faces_up) up += sample.area_m2;
  }
  EXPECT_NEAR(up, 0.02, 1e-9);
  EXPECT_NEAR(all, 2.0 * (0.02 + 0.008 + 0.004), 1e-9);
}

}  // namespace
}  // namespace softbody::virtual_camera
