#include <fmt/format.h>
#include <test_support/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "softbody_tracking/ros/compressed_image.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

sensor_msgs::CompressedImage compressedImage(const cv::Mat& pixels, const char* format,
                                             const char* extension) {
  sensor_msgs::CompressedImage image;
  image.header.stamp = ros::Time(3, 4);
  image.header.frame_id = "camera";
  image.format = format;
  cv::imencode(extension, pixels, image.data);
  return image;
}

/// As compressed_depth_image_transport writes it: 12 bytes of header, and a PNG.
sensor_msgs::CompressedImage compressedDepth(const cv::Mat1w& pixels, const char* format, float a, float b) {
  sensor_msgs::CompressedImage image = compressedImage(pixels, format, ".png");
  std::vector<std::uint8_t> header(12);
  std::memcpy(&header[4], &a, 4);
  std::memcpy(&header[8], &b, 4);
  image.data.insert(image.data.begin(), header.begin(), header.end());
  return image;
}

cv::Mat3b colors() {
  cv::Mat3b image(48, 64);
  image.forEach([](cv::Vec3b& pixel, const int* at) {
    pixel = cv::Vec3b(static_cast<uchar>(4 * at[1]), static_cast<uchar>(5 * at[0]), 200);
  });
  return image;
}

TEST(CompressedImage, ColoursComeBack) {
  const sensor_msgs::ImagePtr png =
      decompressed(compressedImage(colors(), "rgb8; png compressed bgr8", ".png"));
  EXPECT_EQ(png->header.frame_id, "camera");
  EXPECT_EQ(png->header.stamp, ros::Time(3, 4));
  EXPECT_EQ(cv::norm(colorFromMessage(*png), colors(), cv::NORM_INF), 0.0);
  const sensor_msgs::ImagePtr jpeg =
      decompressed(compressedImage(colors(), "rgb8; jpeg compressed bgr8", ".jpg"));
  EXPECT_LT(cv::norm(colorFromMessage(*jpeg), colors(), cv::NORM_L1) / (3.0 * 48 * 64), 4.0);
}

TEST(CompressedImage, MillimetresComeBack) {
  cv::Mat1w depth(48, 64);
  depth.forEach([](std::uint16_t& z, const int* at) { z = static_cast<std::uint16_t>(100 * at[0] + at[1]); });
  for (const char* format :
       {"16UC1; compressedDepth png", "16UC1; compressedDepth", "16UC1; compressedDepth "}) {
    const sensor_msgs::ImagePtr image = decompressed(compressedDepth(depth, format, 0.0f, 0.0f));
    EXPECT_EQ(cv::norm(depthFromMessage(*image), depth, cv::NORM_INF), 0.0) << format;
  }
  const sensor_msgs::ImagePtr image = decompressed(compressedImage(depth, "16UC1; png compressed ", ".png"));
  EXPECT_EQ(cv::norm(depthFromMessage(*image), depth, cv::NORM_INF), 0.0);
}

/// The publisher's defaults: depth_max 10 m, depth_quantization 100.
TEST(CompressedImage, QuantisedMetresComeBackWithinTheirStep) {
  const float a = 100.0f * 101.0f, b = 1.0f - a / 10.0f;
  cv::Mat1f metres(48, 64);
  cv::Mat1w inverse(metres.size());
  for (int v = 0; v < metres.rows; ++v) {
    for (int u = 0; u < metres.cols; ++u) {
      metres(v, u) = v == 7 ? 0.0f : 0.3f + 0.03f * static_cast<float>(v) + 0.001f * static_cast<float>(u);
      inverse(v, u) = v == 7 ? 0 : static_cast<std::uint16_t>(a / metres(v, u) + b);
    }
  }
  const sensor_msgs::ImagePtr image =
      decompressed(compressedDepth(inverse, "32FC1; compressedDepth png", a, b));
  const cv::Mat1f result = depthFromMessage(*image);
  for (int v = 0; v < metres.rows; ++v) {
    for (int u = 0; u < metres.cols; ++u) {
      if (v == 7)
        EXPECT_TRUE(std::isnan(result(v, u)));
      else
        ASSERT_NEAR(result(v, u), metres(v, u), metres(v, u) * metres(v, u) / a + 1e-6f);
    }
  }
}

/// The encoder of the codec RVL, as in Wilson 2017.
std::vector<std::uint8_t> rvlOf(const cv::Mat1w& depth) {
  std::vector<std::uint8_t> bytes(20);  // DepthHeader, columns, rows
  const std::int32_t sides[] = {depth.cols, depth.rows};
  std::memcpy(&bytes[12], sides, sizeof(sides));
  std::vector<std::uint32_t> groups;
  const auto put = [&groups](std::uint32_t number) {
    for (; number > 7; number >>= 3) groups.push_back((number & 7u) | 8u);
    groups.push_back(number);
  };
  const auto runFrom = [&depth](std::size_t at, bool zeros) {
    std::size_t end = at;
    while (end < depth.total() && (depth.ptr<std::uint16_t>()[end] == 0) == zeros) ++end;
    return end;
  };
  int previous = 0;
  for (std::size_t at = 0; at < depth.total();) {
    const std::size_t first = runFrom(at, true), end = runFrom(first, false);
    put(static_cast<std::uint32_t>(first - at));
    put(static_cast<std::uint32_t>(end - first));
    for (at = first; at < end; ++at) {
      const int value = depth.ptr<std::uint16_t>()[at], difference = value - std::exchange(previous, value);
      put(static_cast<std::uint32_t>(difference < 0 ? -2 * difference - 1 : 2 * difference));
    }
  }
  groups.resize((groups.size() + 7) / 8 * 8);
  for (std::size_t word = 0; word < groups.size(); word += 8)
    for (const std::size_t k : {6, 4, 2, 0})
      bytes.push_back(static_cast<std::uint8_t>(groups[word + k] << 4 | groups[word + k + 1]));
  return bytes;
}

TEST(CompressedImage, RvlComesBackWhateverThePixels) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    cv::Mat1w depth(1 + static_cast<int>(random() % 40), 1 + static_cast<int>(random() % 50));
    for (std::uint16_t& z : depth) z = static_cast<std::uint16_t>(random() % 4 == 0 ? 0 : random());
    sensor_msgs::CompressedImage image;
    image.format = "16UC1; compressedDepth rvl";
    image.data = rvlOf(depth);
    EXPECT_EQ(cv::norm(depthFromMessage(*decompressed(image)), depth, cv::NORM_INF), 0.0) << trial;
    image.data.resize(random() % image.data.size());
    EXPECT_THROW(decompressed(image), std::invalid_argument) << "truncated";
  }
}

/// Drivers in Python, and other packages, do not name the format as image_transport does.
TEST(CompressedImage, TheDataDecideAboutTheFormat) {
  cv::Mat1w depth(4, 6);
  depth.forEach(
      [](std::uint16_t& z, const int* at) { z = static_cast<std::uint16_t>(700 + 10 * at[0] + at[1]); });
  for (const char* format : {"", "png", "jpeg", "16UC1; png compressed ", "16UC1; compressedDepth png"}) {
    for (const auto& image :
         {compressedDepth(depth, format, 0.0f, 0.0f), compressedImage(depth, format, ".png")})
      EXPECT_EQ(cv::norm(depthFromMessage(*decompressed(image)), depth, cv::NORM_INF), 0.0) << format;
  }
  for (const char* format : {"", "jpeg", "bgr8; jpeg compressed bgr8"})
    EXPECT_EQ(cv::norm(colorFromMessage(*decompressed(compressedImage(colors(), format, ".png"))), colors()),
              0.0);
}

TEST(CompressedImage, WhatCannotBeDecodedIsRefused) {
  const auto refused = [](const sensor_msgs::CompressedImage& image) {
    EXPECT_THROW(decompressed(image), std::invalid_argument) << image.format;
  };
  sensor_msgs::CompressedImage image;
  refused(image);
  image.format = "16UC1; compressedDepth png";
  refused(image);
  refused(compressedDepth(cv::Mat1w(2, 2, std::uint16_t{1}), "16UC1; compressedDepth rvl", 0.0f, 0.0f));
  refused(compressedImage(cv::Mat3w(2, 2, cv::Vec3w(1, 2, 3)), "rgb16; png compressed bgr16", ".png"));
  std::mt19937 random(3);
  const sensor_msgs::CompressedImage whole = compressedImage(colors(), "bgr8; jpeg compressed bgr8", ".jpg");
  for (int trial = 0; trial < 500; ++trial) {
    image = whole;
    image.data.resize(random() % image.data.size());
    for (int k = 0; k < 20 && !image.data.empty(); ++k)
      image.data[random() % image.data.size()] = static_cast<std::uint8_t>(random());
    try {
      decompressed(image);
    } catch (const std::invalid_argument&) {
    }
  }
}

/// The sentence of a refusal; empty: the image is decoded.
std::string refusal(const sensor_msgs::CompressedImage& image) {
  return complaint([&] { decompressed(image); });
}

TEST(CompressedImage, AFewBytesThatStandForVeryManyPixelsAreRefused) {
  const char* const png = "mono8; png compressed ";
  EXPECT_EQ(refusal(compressedImage(cv::Mat1b::zeros(2, 1 << 14), png, ".png")), "");
  const std::pair<cv::Mat, const char*> tooLarge[] = {{cv::Mat1b::zeros(4097, 8192), ".png"},
                                                      {cv::Mat1b::zeros(2, 20'000), ".png"},
                                                      {cv::Mat1b::zeros(20'000, 2), ".jpg"}};
  for (const auto& [pixels, extension] : tooLarge) {
    const std::string sentence = refusal(compressedImage(pixels, png, extension));
    EXPECT_TRUE(says(sentence, fmt::format("{}x{} pixels; allowed: up to", pixels.cols, pixels.rows)));
  }
}

TEST(CompressedImage, AJpegOfVeryManyScansIsRefused) {
  sensor_msgs::CompressedImage image;
  image.format = "bgr8; jpeg compressed bgr8";
  cv::imencode(".jpg", colors(), image.data, {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  EXPECT_EQ(refusal(image), "");
  const std::uint8_t start[] = {0xFF, 0xDA};
  const auto last = std::find_end(image.data.begin(), image.data.end(), std::begin(start), std::end(start));
  const std::vector<std::uint8_t> scan(last, image.data.end() - 2);
  for (int k = 0; k < 100; ++k) image.data.insert(image.data.end() - 2, scan.begin(), scan.end());
  EXPECT_TRUE(says(refusal(image), "scans; allowed"));
}

TEST(CompressedImage, ALongFormatDoesNotFillTheLog) {
  sensor_msgs::CompressedImage image;
  image.format.assign(1'000'000, 'x');
  EXPECT_LT(refusal(image).size(), 500u);
}

}  // namespace
}  // namespace softbody
