#include "softbody_tracking/tool/tool_mask.h"

#include <gtest/gtest.h>

namespace softbody {
namespace {

/// A wall 0.5 m away.
RgbdFrame wall(Nanoseconds stamp) {
  const Pinhole camera{160, 120, 150.0, 150.0, 79.5, 59.5};
  return {stamp, camera, cv::Mat3b(120, 160, cv::Vec3b(90, 90, 90)), cv::Mat1f(120, 160, 0.5f)};
}

/// A blade of 60 x 20 mm about the optical axis, turned by some angle about the image's x axis.
Points blade(double z, double tilt = 0.0) {
  Points corners(4, 3);
  corners << -0.03, -0.01, 0.0, 0.03, -0.01, 0.0, 0.03, 0.01, 0.0, -0.03, 0.01, 0.0;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return (corners * R.transpose()).rowwise() + Eigen::RowVector3d(0.0, 0.0, z);
}

TEST(ToolMask, HidesTheBladeAndAMargin) {
  ToolMask mask;
  mask.setBlade(0, blade(0.498));
  const RgbdFrame frame = wall(33'000'000);
  const RgbdFrame without = mask.withoutBlade(frame);
  const cv::Mat1f& depth = without.depth;
  EXPECT_EQ(cv::countNonZero((depth == 0.0f) != (without.covered != 0)), 0);
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const Eigen::Vector3d p = frame.camera.unproject(u, v, 0.5);
      const double dx = std::max(0.0, std::abs(p.x()) - 0.03), dy = std::max(0.0, std::abs(p.y()) - 0.01);
      const double beside = std::hypot(dx, dy);
      if (beside < 0.007) {
        EXPECT_EQ(depth(v, u), 0.0f) << u << ", " << v;
      }
      if (beside > 0.009) {
        EXPECT_EQ(depth(v, u), 0.5f) << u << ", " << v;
      }
    }
  }
  EXPECT_EQ(frame.depth(60, 80), 0.5f) << "the frame itself was changed";
}

/// A shiny blade returns no depth, but hides what is behind it all the same.
TEST(ToolMask, CoversWhatIsUnderABladeWithoutDepth) {
  for (const double tilt : {0.0, 0.7, M_PI / 2.0}) {
    const Points corners = blade(0.45, tilt);
    ToolMask mask;
    mask.setBlade(0, corners);
    RgbdFrame frame = wall(0);
    EXPECT_TRUE(cv::countNonZero(mask.withoutBlade(frame).covered) == 0) << "the wall behind is measured";
    frame.depth.setTo(0.0f);
    const RgbdFrame without = mask.withoutBlade(frame);
    for (int v = 0; v < frame.depth.rows; ++v) {
      for (int u = 0; u < frame.depth.cols; ++u) {
        // Of the blade's middle, by its width in the image.
        const double x = std::abs(u - 79.5) * 0.45 / 150.0,
                     y = std::abs(v - 59.5) * 0.45 / 150.0 - 0.01 * std::cos(tilt);
        if (x < 0.029 && y < 0.006) {
          EXPECT_NE(without.covered(v, u), 0) << u << ", " << v << " tilted by " << tilt;
        }
        if (x > 0.042 || y > 0.012) {
          EXPECT_EQ(without.covered(v, u), 0) << u << ", " << v << " tilted by " << tilt;
        }
      }
    }
  }
}

TEST(ToolMask, LeavesWhatIsBehindOrBeforeTheBlade) {
  for (const double z : {0.48, 0.52}) {
    ToolMask mask;
    mask.setBlade(0, blade(z));
    EXPECT_EQ(cv::countNonZero(mask.withoutBlade(wall(0)).depth != 0.5f), 0) << z;
  }
}

TEST(ToolMask, HidesOnlyWhereABladeOnEdgeMeetsTheBody) {
  ToolMask mask;
  mask.setBlade(0, blade(0.5, M_PI / 2.0));
  const cv::Mat1f depth = mask.withoutBlade(wall(0)).depth;
  EXPECT_EQ(depth(60, 80), 0.0f);
  EXPECT_EQ(depth(60 + 6, 80), 0.5f);  // 20 mm beside it
}

TEST(ToolMask, StaysInTheImageWhereTheCameraClaimsALargerOne) {
  ToolMask mask;
  mask.setBlade(0, blade(0.5));
  RgbdFrame frame = wall(0);
  frame.camera = {1600, 1200, 1500.0, 1500.0, 79.5, 59.5};
  const cv::Mat1f depth = mask.withoutBlade(frame).depth;
  EXPECT_EQ(depth.size(), frame.depth.size());
  EXPECT_EQ(depth(60, 80), 0.0f);
}

TEST(ToolMask, ForgetsABladeThatIsNoLongerSeen) {
  ToolMask mask;
  const RgbdFrame late = wall(300'000'000);
  EXPECT_EQ(mask.withoutBlade(late).depth.data, late.depth.data);
  mask.setBlade(0, blade(0.5));
  EXPECT_EQ(mask.withoutBlade(late).depth.data, late.depth.data);
  EXPECT_GT(cv::countNonZero(mask.withoutBlade(wall(100'000'000)).depth == 0.0f), 100);
  mask.setBlade(300'000'000, blade(-0.1));
  EXPECT_EQ(mask.withoutBlade(late).depth.data, late.depth.data) << "a blade behind the camera";
}

}  // namespace
}  // namespace softbody
