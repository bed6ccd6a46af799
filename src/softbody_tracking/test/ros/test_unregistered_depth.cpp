#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "softbody_common/ros/camera_messages.h"
#include "softbody_tracking/ros/unregistered_depth.h"

namespace softbody {
namespace {

const Pinhole kColor{64, 48, 60.0, 60.0, 32.0, 24.0}, kDepth{32, 24, 25.0, 25.0, 16.0, 12.0};

sensor_msgs::Image imageOf(const Pinhole& camera, const char* frame) {
  sensor_msgs::Image image;
  image.header.frame_id = frame;
  image.width = static_cast<std::uint32_t>(camera.width);
  image.height = static_cast<std::uint32_t>(camera.height);
  return image;
}

Eigen::Isometry3d shifted(const std::string& target, const std::string& source, const ros::Time&) {
  if (target != "color" || source != "depth") throw std::runtime_error("no such frame");
  return Eigen::Isometry3d(Eigen::Translation3d(0.03, 0.0, 0.0));
}

std::string refusal(const Pinhole& depth, const sensor_msgs::CameraInfo* info, const char* frame) {
  try {
    unregisteredDepthCamera(imageOf(kColor, "color"), imageOf(depth, frame), toMessage(kColor), info,
                            shifted);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(UnregisteredDepth, DepthOfColoursCameraIsRegistered) {
  const sensor_msgs::Image image = imageOf(kColor, "color"), other = imageOf(kColor, "aligned");
  const sensor_msgs::CameraInfo info = toMessage(kColor);
  EXPECT_FALSE(unregisteredDepthCamera(image, image, info, nullptr, shifted));
  EXPECT_FALSE(unregisteredDepthCamera(image, image, info, &info, shifted));
  EXPECT_FALSE(unregisteredDepthCamera(image, other, info, &info, shifted))
      << "some drivers name another frame";
}

TEST(UnregisteredDepth, AnotherCameraIsPlacedByTf) {
  const sensor_msgs::CameraInfo info = toMessage(kColor), depth_info = toMessage(kDepth);
  const auto camera = unregisteredDepthCamera(imageOf(kColor, "/color"), imageOf(kDepth, "/depth"), info,
                                              &depth_info, shifted);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->rectified, kDepth);
  EXPECT_EQ(camera->T_color_depth.translation().x(), 0.03);
  const auto scaled =
      unregisteredDepthCamera(imageOf(kColor, "color"), imageOf(kDepth, "color"), info, &depth_info, shifted);
  ASSERT_TRUE(scaled);
  EXPECT_TRUE(scaled->T_color_depth.isApprox(Eigen::Isometry3d::Identity()));
}

TEST(UnregisteredDepth, WhatIsMissingIsNamed) {
  const sensor_msgs::CameraInfo depth_info = toMessage(kDepth);
  EXPECT_NE(refusal(kDepth, nullptr, "depth").find("depth_info:="), std::string::npos);
  EXPECT_NE(refusal(kDepth, &depth_info, "elsewhere").find("/tf_static"), std::string::npos);
  EXPECT_EQ(refusal(kDepth, &depth_info, "depth"), "");
}

}  // namespace
}  // namespace softbody
