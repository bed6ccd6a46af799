#include "softbody_tracking/ros/compressed_image.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

namespace softbody {
namespace {

namespace enc = sensor_msgs::image_encodings;

/// Before the PNG of compressedDepth: an enumeration, and A and B of depth = A / (value - B).
struct DepthHeader {
  std::int32_t format;
  float a, b;
};
static_assert(sizeof(DepthHeader) == 12, "as compressed_depth_image_transport writes it");

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

cv::Mat decoded(const sensor_msgs::CompressedImage& image, std::size_t offset) {
  cv::Mat pixels;
  if (image.data.size() > offset) {
    const cv::Mat bytes(1, static_cast<int>(image.data.size() - offset), CV_8UC1,
                        const_cast<std::uint8_t*>(image.data.data()) + offset);
    try {
      pixels = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {  // an image with too many pixels
    }
  }
  if (pixels.empty()) {
    throw std::invalid_argument(
        fmt::format("a compressed image of format '{}' with {} bytes cannot be decoded", image.format,
                    image.data.size()));
  }
  return pixels;
}

/// Metres from 16 bits of inverse depth; 0 means not measured.
cv::Mat1f metres(const cv::Mat1w& inverse, const DepthHeader& header) {
  cv::Mat1f depth(inverse.size());
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const std::uint16_t value = inverse(v, u);
      depth(v, u) = value == 0 ? std::numeric_limits<float>::quiet_NaN() : header.a / (value - header.b);
    }
  }
  return depth;
}

cv_bridge::CvImage depthImage(const sensor_msgs::CompressedImage& image) {
  if (contains(image.format, "rvl")) {
    throw std::invalid_argument(
        fmt::format("the compressed depth has the format '{}'; set the publisher's parameter "
                    "compressedDepth/format to png",
                    image.format));
  }
  const cv::Mat pixels = decoded(image, sizeof(DepthHeader));
  if (pixels.type() != CV_16UC1) {
    throw std::invalid_argument(
        fmt::format("the compressed depth of format '{}' has pixels of type {}; expected "
                    "a PNG of 16 bits",
                    image.format, cv::typeToString(pixels.type())));
  }
  if (image.format.rfind(enc::TYPE_32FC1, 0) != 0) return {image.header, enc::TYPE_16UC1, pixels};
  DepthHeader header{};
  std::memcpy(&header, image.data.data(), sizeof(header));
  return {image.header, enc::TYPE_32FC1, metres(pixels, header)};
}

/// OpenCV gives colours as BGR. Older publishers compressed RGB without swapping the channels.
std::string encodingOf(const cv::Mat& pixels, const std::string& format) {
  const bool swapped = contains(format, "compressed rgb");
  switch (pixels.type()) {
    case CV_8UC1:
      return enc::MONO8;
    case CV_8UC3:
      return swapped ? enc::RGB8 : enc::BGR8;
    case CV_8UC4:
      return swapped ? enc::RGBA8 : enc::BGRA8;
    case CV_16UC1:
      return enc::TYPE_16UC1;
    default:
      throw std::invalid_argument(
          fmt::format("a compressed image of format '{}' has pixels of type {}, which cannot "
                      "be used",
                      format, cv::typeToString(pixels.type())));
  }
}

}  // namespace

sensor_msgs::ImagePtr decompressed(const sensor_msgs::CompressedImage& image) {
  if (contains(image.format, "compressedDepth")) return depthImage(image).toImageMsg();
  const cv::Mat pixels = decoded(image, 0);
  return cv_bridge::CvImage(image.header, encodingOf(pixels, image.format), pixels).toImageMsg();
}

}  // namespace softbody
