#include <gtest/gtest.h>

#include "camera/stream_advice.h"

namespace softbody {
namespace {

using Types = std::map<std::string, std::string>;

const Types kAzureKinect{{"/rgb/image_raw", "sensor_msgs/Image"},
                         {"/rgb/camera_info", "sensor_msgs/CameraInfo"},
                         {"/ir/image_raw", "sensor_msgs/Image"},
                         {"/depth_to_rgb/image_raw", "sensor_msgs/Image"},
                         {"/depth_to_rgb/camera_info", "sensor_msgs/CameraInfo"},
                         {"/points2", "sensor_msgs/PointCloud2"}};

bool names(const std::string& advice, const std::string& words) {
  return advice.find(words) != std::string::npos;
}

TEST(StreamAdvice, NamesTheTopicsThatFitTheirTypeAndTheArgument) {
  const std::string color = streamAdvice(Stream::kColor, "/camera/color/image_raw", kAzureKinect);
  EXPECT_TRUE(names(color, "color:=") && names(color, "/rgb/image_raw (sensor_msgs/Image)")) << color;
  EXPECT_FALSE(names(color, "/ir/") || names(color, "/depth_to_rgb/") || names(color, "/points2")) << color;
  const std::string depth = streamAdvice(Stream::kDepth, "/camera/depth", kAzureKinect);
  EXPECT_TRUE(names(depth, "depth:=") && names(depth, "/depth_to_rgb/image_raw (sensor_msgs/Image)"))
      << depth;
  const std::string info = streamAdvice(Stream::kColorInfo, "/camera/color/camera_info", kAzureKinect);
  EXPECT_TRUE(names(info, "color_info:=") && names(info, "/rgb/camera_info (sensor_msgs/CameraInfo)"))
      << info;
}

TEST(StreamAdvice, EachMissingStreamHasItsOwnRemedy) {
  EXPECT_TRUE(names(streamAdvice(Stream::kColor, "/c", {}), "start the camera's driver"));
  EXPECT_TRUE(names(streamAdvice(Stream::kColorInfo, "/c", {}), "calibrate the camera"));
  EXPECT_TRUE(names(streamAdvice(Stream::kDepth, "/c", {}), "align_depth:=true"));
}

TEST(StreamAdvice, CompressedImagesNeedTheTransport) {
  const Types types{{"/c/compressed", "sensor_msgs/CompressedImage"},
                    {"/d/compressedDepth", "sensor_msgs/CompressedImage"}};
  EXPECT_TRUE(names(streamAdvice(Stream::kColor, "/c", types), "color_transport:=compressed"));
  EXPECT_TRUE(names(streamAdvice(Stream::kDepth, "/d", types), "depth_transport:=compressedDepth"));
}

TEST(StreamAdvice, SaysTheTypeThatItFound) {
  const std::string advice = streamAdvice(Stream::kColor, "/c", {{"/c", "sensor_msgs/PointCloud2"}});
  EXPECT_TRUE(names(advice, "sensor_msgs/PointCloud2 instead of sensor_msgs/Image")) << advice;
  EXPECT_TRUE(names(streamAdvice(Stream::kColor, "/c", {{"/c", "sensor_msgs/Image"}}), "silent"));
}

const StreamTopics kCameraTopics{
    StreamTopic{"/camera/color/image_raw", 0, "/camera/color/image_raw"},
    StreamTopic{"/camera/color/camera_info", 0, "/camera/color/camera_info"},
    StreamTopic{"/camera/aligned_depth_to_color/image_raw", 0, "/camera/aligned_depth_to_color/image_raw"}};
const std::vector<StreamMonitor::Silent> kAllSilent{
    {Stream::kColor, false}, {Stream::kColorInfo, false}, {Stream::kDepth, false}};

TEST(StreamAdvice, ACameraInAnotherNamespaceIsNamedOnce) {
  const Types types{{"/d435/color/image_raw", "sensor_msgs/Image"},
                    {"/d435/color/camera_info", "sensor_msgs/CameraInfo"},
                    {"/d435/aligned_depth_to_color/image_raw", "sensor_msgs/Image"},
                    {"/d435/infra1/image_raw", "sensor_msgs/Image"}};
  const std::string advice = adviceOn(kAllSilent, kCameraTopics, types);
  EXPECT_TRUE(names(advice, "set camera:=/d435")) << advice;
  EXPECT_FALSE(names(advice, "color:=") || names(advice, "depth:=")) << advice;
  const Types compressed{
      {"/a/b/color/image_raw/compressed", "sensor_msgs/CompressedImage"},
      {"/a/b/aligned_depth_to_color/image_raw/compressedDepth", "sensor_msgs/CompressedImage"}};
  EXPECT_TRUE(names(adviceOn(kAllSilent, kCameraTopics, compressed), "set camera:=/a/b"));
}

TEST(StreamAdvice, OtherNamesNeedTheirOwnArguments) {
  for (const Types& types : {kAzureKinect, Types{{"/d435/color/image_raw", "sensor_msgs/Image"}}}) {
    const std::string advice = adviceOn(kAllSilent, kCameraTopics, types);
    EXPECT_FALSE(names(advice, "camera:=")) << advice;
    EXPECT_TRUE(names(advice, "color:=")) << advice;
  }
}

TEST(StreamAdvice, ImagesWithoutAStampAreNoMatterOfTheNetwork) {
  const Types types{{"/camera/color/image_raw", "sensor_msgs/Image"}};
  const std::string advice = adviceOn({{Stream::kColor, true}}, kCameraTopics, types);
  EXPECT_TRUE(names(advice, "must set header.stamp")) << advice;
  EXPECT_FALSE(names(advice, "ROS_IP")) << advice;
}

}  // namespace
}  // namespace softbody
