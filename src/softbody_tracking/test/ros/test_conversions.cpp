#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>

#include "softbody_common/ros/camera_messages.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

sensor_msgs::Image imageOf(const std::string& encoding, int bytes_per_pixel, int width = 6, int height = 4,
                           int padding = 0) {
  sensor_msgs::Image image;
  image.encoding = encoding;
  image.width = width;
  image.height = height;
  image.step = width * bytes_per_pixel + padding;
  image.data.resize(image.step * height);
  std::mt19937 random(11);
  for (auto& byte : image.data) byte = static_cast<std::uint8_t>(random());
  return image;
}

TEST(TrackingConversions, ColourEncodingsAgreeOnThePixels) {
  const sensor_msgs::Image rgb = imageOf("rgb8", 3, 6, 4, 5);
  sensor_msgs::Image bgr = rgb, bgra = imageOf("bgra8", 4);
  bgr.encoding = "bgr8";
  for (int v = 0; v < 4; ++v) {
    for (int u = 0; u < 6; ++u) {
      std::uint8_t* pixel = &bgr.data[v * bgr.step + 3 * u];
      std::swap(pixel[0], pixel[2]);
      std::memcpy(&bgra.data[v * bgra.step + 4 * u], pixel, 3);
    }
  }
  const cv::Mat3b expected = colorFromMessage(rgb);
  EXPECT_EQ(expected(1, 2)[2], rgb.data[rgb.step + 6]);
  EXPECT_EQ(cv::norm(colorFromMessage(bgr), expected, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(colorFromMessage(bgra), expected, cv::NORM_INF), 0.0);
  EXPECT_THROW(colorFromMessage(imageOf("mono8", 1)), std::invalid_argument);
  EXPECT_EQ(colorFromMessage(imageOf("yuv422", 2)).size(), cv::Size(6, 4));
}

TEST(TrackingConversions, DepthKeepsItsNumbers) {
  const sensor_msgs::Image millimetres = imageOf("16UC1", 2, 6, 4, 2);
  const cv::Mat depth = depthFromMessage(millimetres);
  std::uint16_t value = 0;
  std::memcpy(&value, &millimetres.data[2 * millimetres.step + 2 * 3], 2);
  EXPECT_EQ(depth.type(), CV_16UC1);
  EXPECT_EQ(depth.at<std::uint16_t>(2, 3), value);
  EXPECT_EQ(depthFromMessage(imageOf("32FC1", 4)).type(), CV_32FC1);
  EXPECT_EQ(depthFromMessage(imageOf("mono16", 2)).type(), CV_16UC1);
}

TEST(TrackingConversions, BigEndianDepthHasTheSameNumbers) {
  for (const auto& [encoding, bytes] :
       {std::pair("16UC1", 2), std::pair("mono16", 2), std::pair("32FC1", 4)}) {
    const sensor_msgs::Image little = imageOf(encoding, bytes, 6, 4, 4);
    sensor_msgs::Image big = little;
    big.is_bigendian = 1;
    for (std::size_t v = 0; v < 4; ++v) {
      for (auto number = big.data.begin() + v * big.step;
           number < big.data.begin() + v * big.step + 6 * bytes; number += bytes)
        std::reverse(number, number + bytes);
    }
    const cv::Mat expected = depthFromMessage(little), depth = depthFromMessage(big);
    ASSERT_EQ(depth.type(), expected.type()) << encoding;
    for (int v = 0; v < 4; ++v)
      EXPECT_EQ(std::memcmp(depth.ptr(v), expected.ptr(v), 6 * bytes), 0) << encoding << " row " << v;
  }
}

/// Where nothing must be changed, nothing is copied.
TEST(TrackingConversions, RectifiedImagesAreReadWhereTheyAre) {
  const sensor_msgs::CameraInfo info = toMessage(Pinhole{6, 4, 5.0, 5.0, 3.0, 2.0});
  const sensor_msgs::Image color = imageOf("bgr8", 3);
  sensor_msgs::Image depth = imageOf("32FC1", 4);
  cv::Mat1f written(4, 6, reinterpret_cast<float*>(depth.data.data()));
  written.setTo(0.7f);
  written.row(1).setTo(std::numeric_limits<float>::quiet_NaN());
  written.row(2).setTo(0.0f);
  const RgbdFrame frame = frameFromRectified(color, depth, info);
  EXPECT_EQ(frame.color.data, color.data.data());
  EXPECT_EQ(frame.depth.data, depth.data.data());
  written(0, 3) = -0.5f;
  written(3, 5) = 1e3f;
  written(3, 4) = std::numeric_limits<float>::infinity();
  const RgbdFrame changed = frameFromRectified(color, depth, info);
  EXPECT_NE(changed.depth.data, depth.data.data());
  for (const cv::Point& pixel : {cv::Point(3, 0), cv::Point(5, 3), cv::Point(4, 3)})
    EXPECT_EQ(changed.depth(pixel), 0.0f);
  EXPECT_EQ(changed.depth(0, 2), 0.7f);
  EXPECT_TRUE(std::isnan(changed.depth(1, 2)));
}

TEST(TrackingConversions, ColoursAreHandedOnInBothOrdersAndNothingElse) {
  for (const char* usual : {"rgb8", "bgr8"}) EXPECT_TRUE(isUsualColor(imageOf(usual, 3, 6, 4, 5))) << usual;
  for (const char* other : {"BGR8", "8UC3", "bayer_rggb8", "mono8", "rgba8", ""})
    EXPECT_FALSE(isUsualColor(imageOf(other, 4))) << other;
  sensor_msgs::Image cut = imageOf("rgb8", 3);
  cut.data.pop_back();
  EXPECT_THROW(isUsualColor(cut), std::invalid_argument);
}

TEST(TrackingConversions, MalformedImagesAreRefused) {
  const auto refused = [](sensor_msgs::Image image, const char* why) {
    EXPECT_THROW(colorFromMessage(image), std::invalid_argument) << why;
    EXPECT_THROW(depthFromMessage(image), std::invalid_argument) << why;
  };
  sensor_msgs::Image image = imageOf("rgb8", 3);
  image.data.pop_back();
  refused(image, "data too short");
  image = imageOf("16UC1", 2);
  image.step = 3;
  refused(image, "step too short");
  refused(imageOf("nonsense", 3), "unknown encoding");
  refused(imageOf("", 3), "no encoding");
  image = imageOf("rgb8", 3);
  image.width = 0x80000000u;
  refused(image, "width that overflows");
  image.width = image.height = 0;
  refused(image, "no pixels");
  EXPECT_THROW(colorFromMessage(imageOf("16UC1", 2)), std::invalid_argument);
  EXPECT_THROW(depthFromMessage(imageOf("rgb8", 3)), std::invalid_argument);
}

TEST(TrackingConversions, NoHeaderHoweverRandomCrashes) {
  std::mt19937 random(17);
  const char* const encodings[] = {"rgb8",  "bgr8",   "mono8", "mono16",      "16UC1", "32FC1", "64FC4",
                                   "8UC17", "yuv422", "16SC1", "bayer_rggb8", "rgb16", "",      "\xff\xfe"};
  for (int trial = 0; trial < 5000; ++trial) {
    sensor_msgs::Image image;
    image.encoding = encodings[random() % std::size(encodings)];
    image.width = trial % 3 == 0 ? random() : random() % 9;
    image.height = trial % 5 == 0 ? random() : random() % 9;
    image.step = trial % 7 == 0 ? random() : random() % 100;
    image.is_bigendian = random() % 2;
    image.data.resize(random() % 700);
    for (const auto& convert : {+[](const sensor_msgs::Image& m) { return cv::Mat(colorFromMessage(m)); },
                                +[](const sensor_msgs::Image& m) { return depthFromMessage(m); }}) {
      try {
        const cv::Mat result = convert(image);
        EXPECT_EQ(result.cols, static_cast<int>(image.width));
      } catch (const std::invalid_argument&) {
      }
    }
  }
}

TEST(TrackingConversions, CloudsAreLaidOutAsTheirFieldsSay) {
  const std::vector<ColoredPoint> points{{1, 2, 3, 0x0a0b0c}, {4, 5, 6, 7}, {7, 8, 9, 1}, {1, 1, 1, 1}};
  const sensor_msgs::PointCloud2Ptr cloud = toMessage(points, 2, std_msgs::Header());
  EXPECT_EQ(cloud->width * cloud->height, 4u);
  EXPECT_EQ(cloud->data.size(), cloud->row_step * cloud->height);
  float z = 0.0f;
  std::memcpy(&z, &cloud->data[cloud->point_step + cloud->fields[2].offset], 4);
  EXPECT_EQ(z, 6.0f);
  EXPECT_EQ(toMessage(points, 0, std_msgs::Header())->height, 1u);
}

}  // namespace
}  // namespace softbody
