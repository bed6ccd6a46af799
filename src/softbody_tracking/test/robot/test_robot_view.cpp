#include <gtest/gtest.h>

#include "robot/link_shapes.h"
#include "robot/robot_view.h"
#include "robot/solids.h"

namespace softbody {
namespace {

TEST(RobotView, ALinkHoldsACameraInItOrNearerThanATenthOfAMetre) {
  for (int seed = 0; seed < 200; ++seed) {
    const Eigen::Vector3d size(drawn(seed, 0, 0.02, 1), drawn(seed, 1, 0.02, 1), drawn(seed, 2, 0.02, 1));
    const Eigen::Vector3d camera(drawn(seed, 3, -1, 1), drawn(seed, 4, -1, 1), drawn(seed, 5, -1, 1));
    const Eigen::Vector3d outside = (camera.cwiseAbs() - 0.5 * size).cwiseMax(0.0);
    EXPECT_EQ(holdsCamera(boxMesh(size), camera), outside.norm() < 0.1) << seed;
  }
}

TEST(RobotView, ACameraInALargeHousingIsHeld) {
  const TriangleMesh housing = sphereMesh(2.0);
  EXPECT_TRUE(holdsCamera(housing, Eigen::Vector3d(0.5, 0.2, -0.3)));
  EXPECT_FALSE(holdsCamera(housing, Eigen::Vector3d(0.0, 0.0, 2.11)));
}

TEST(RobotView, AnOpenSheetHoldsOnlyANearCamera) {
  TriangleMesh sheet = boxMesh({1.0, 1.0, 1.0});
  sheet.triangles = sheet.triangles.topRows(2).eval();  // its bottom
  EXPECT_FALSE(holdsCamera(sheet, Eigen::Vector3d::Zero()));
  EXPECT_TRUE(holdsCamera(sheet, Eigen::Vector3d(0.2, 0.1, -0.45)));
}

}  // namespace
}  // namespace softbody
