#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>

#include "softbody_tracking/camera/point_cloud.h"

namespace softbody {
namespace {

RgbdFrame randomFrame() {
  RgbdFrame frame;
  frame.camera = {40, 30, 35.0, 36.0, 19.0, 15.0};
  frame.color = cv::Mat3b(30, 40);
  frame.depth = cv::Mat1f(30, 40);
  cv::theRNG().state = 7;
  cv::randu(frame.color, 0, 255);
  cv::randu(frame.depth, 0.4, 0.9);
  frame.depth(cv::Rect(3, 4, 10, 5)) = 0.0f;
  frame.depth(cv::Rect(20, 9, 6, 5)) = std::numeric_limits<float>::quiet_NaN();
  return frame;
}

TEST(PointCloud, OrganizedPointsProjectOntoTheirPixels) {
  const RgbdFrame frame = randomFrame();
  const std::vector<ColoredPoint> points = organizedCloud(frame);
  ASSERT_EQ(points.size(), frame.depth.total());
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 40; ++u) {
      const ColoredPoint& p = points[v * 40 + u];
      EXPECT_EQ(std::isnan(p.z), !(frame.depth(v, u) > 0.0f));
      if (std::isnan(p.z)) continue;
      EXPECT_LT((frame.camera.project({p.x, p.y, p.z}) - Eigen::Vector2d(u, v)).norm(), 1e-4);
      EXPECT_EQ(p.rgb >> 16, frame.color(v, u)[2]);
      EXPECT_EQ(p.rgb & 0xff, frame.color(v, u)[0]);
    }
  }
}

TEST(PointCloud, VoxelsHoldOnePointEachAndKeepTheMean) {
  const RgbdFrame frame = randomFrame();
  const double size = 0.05;
  const std::vector<ColoredPoint> points = voxelCloud(frame, size);
  std::set<std::tuple<int, int, int>> seen, expected;
  const auto cell = [size](const Eigen::Vector3d& p) {
    return std::make_tuple(static_cast<int>(std::floor(p.x() / size)),
                           static_cast<int>(std::floor(p.y() / size)),
                           static_cast<int>(std::floor(p.z() / size)));
  };
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 40; ++u) {
      if (frame.depth(v, u) > 0.0f) expected.insert(cell(frame.camera.unproject(u, v, frame.depth(v, u))));
    }
  }
  for (const ColoredPoint& p : points) EXPECT_TRUE(seen.insert(cell({p.x, p.y, p.z})).second);
  EXPECT_EQ(seen, expected);
}

TEST(PointCloud, OneLargeVoxelIsTheMeanOfAllPixels) {
  RgbdFrame frame = randomFrame();
  frame.camera.cx = frame.camera.cy = -10.0;  // all points in the first octant
  const std::vector<ColoredPoint> points = voxelCloud(frame, 100.0);
  ASSERT_EQ(points.size(), 1u);
  cv::patchNaNs(frame.depth, 0.0);
  const double z = cv::sum(frame.depth)[0] / cv::countNonZero(frame.depth);
  EXPECT_NEAR(points[0].z, z, 1e-5);
}

TEST(PointCloud, AThinnedCloudHasPointsOfEveryNthPixelWithDepth) {
  RgbdFrame frame = randomFrame();
  frame.depth(0, 0) = 0.0f;
  const std::vector<ColoredPoint> all = organizedCloud(frame);
  const auto with_depth = static_cast<std::size_t>(cv::countNonZero(frame.depth > 0.0f));
  EXPECT_EQ(thinnedCloud(frame, 30 * 40).size(), with_depth);
  for (const int most : {1, 7, 100, 1199}) {
    const std::vector<ColoredPoint> points = thinnedCloud(frame, most);
    EXPECT_LE(points.size(), static_cast<std::size_t>(most));
    for (const ColoredPoint& p : points) {
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&p](const ColoredPoint& q) {
        return p.x == q.x && p.y == q.y && p.z == q.z && p.rgb == q.rgb;
      }));
    }
  }
  EXPECT_GT(thinnedCloud(frame, 100).size(), 20u);
  EXPECT_THROW(thinnedCloud(frame, 0), std::invalid_argument);
}

TEST(PointCloud, TheVoxelSizeMustBePositive) {
  EXPECT_THROW(voxelCloud(randomFrame(), 0.0), std::invalid_argument);
  EXPECT_THROW(voxelCloud(randomFrame(), NAN), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
