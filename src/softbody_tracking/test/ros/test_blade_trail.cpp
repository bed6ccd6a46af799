#include <gtest/gtest.h>

#include "ros/blade_trail.h"

namespace softbody {
namespace {

using visualization_msgs::Marker;

constexpr Nanoseconds kFrame = 33'333'333;

Points triangle() {
  Points blade(3, 3);
  blade << 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.02, 0.0;
  return blade;
}

/// A blade that moves along z, a millimetre a frame.
class BladeTrailTest : public ::testing::Test {
 protected:
  void move(Nanoseconds stamp) {
    trail_.add(stamp, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z_ += 0.001)));
  }
  Marker marker(const std::string& name) const {
    for (const Marker& marker : trail_.markers(std_msgs::Header()).markers) {
      if (marker.ns == name) return marker;
    }
    return {};
  }

  double z_ = 0.0;
  BladeTrail trail_{triangle()};
};

TEST_F(BladeTrailTest, OutlinesTheBladeWhereItIs) {
  EXPECT_TRUE(trail_.markers(std_msgs::Header()).markers.empty());
  move(0);
  move(kFrame);
  const Marker blade = marker("blade");
  ASSERT_EQ(blade.points.size(), 6u);
  for (const auto& point : blade.points) EXPECT_DOUBLE_EQ(point.z, z_);
}

TEST_F(BladeTrailTest, FadesFromTheBladeBackwards) {
  move(0);
  EXPECT_EQ(marker("trail").action, static_cast<int>(Marker::DELETE));
  for (int k = 1; k <= 20; ++k) move(k * kFrame);
  const Marker trail = marker("trail");
  EXPECT_EQ(trail.action, static_cast<int>(Marker::ADD));
  ASSERT_EQ(trail.points.size(), trail.colors.size());
  ASSERT_EQ(trail.points.size(), 20u * 2u * (3u + 3u));
  for (std::size_t i = 0; i < trail.points.size(); ++i) {
    const float fullest = 1.0f - static_cast<float>(z_ - trail.points[i].z) / 0.001f * 33.3f / 1500.0f;
    EXPECT_LE(trail.colors[i].a, fullest + 1e-3f);
    EXPECT_GT(trail.colors[i].a, 0.0f);
  }
}

TEST_F(BladeTrailTest, EndsAfterASecondAndAHalf) {
  for (int k = 0; k <= 90; ++k) move(k * kFrame);
  double farthest = 0.0;
  for (const auto& point : marker("trail").points) farthest = std::max(farthest, z_ - point.z);
  EXPECT_NEAR(farthest, 0.045, 1e-9);  // 45 frames
}

TEST_F(BladeTrailTest, BeginsAnewAfterAGapAndWhenTimeJumpsBack) {
  move(0);
  move(kFrame);
  move(kFrame + 300'000'000);
  EXPECT_TRUE(marker("trail").points.empty());
  move(2 * kFrame + 300'000'000);
  EXPECT_FALSE(marker("trail").points.empty());
  move(0);
  EXPECT_TRUE(marker("trail").points.empty());
}

}  // namespace
}  // namespace softbody
