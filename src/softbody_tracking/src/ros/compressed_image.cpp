#include "softbody_tracking/ros/compressed_image.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "ros/rvl.h"
#include "softbody_common/images/encoded_image.h"

namespace softbody {
namespace {

namespace enc = sensor_msgs::image_encodings;

/// Before the PNG or RVL of compressedDepth: an enumeration, and A and B of depth = A / (value - B).
struct DepthHeader {
  std::int32_t format;
  float a, b;
};
static_assert(sizeof(DepthHeader) == 12, "as compressed_depth_image_transport writes it");

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// What a sender calls a format may be as long as a message: its beginning says enough.
std::string quoted(const std::string& format) { return "'" + format.substr(0, 60) + "'"; }

cv::Mat decoded(const sensor_msgs::CompressedImage& image, std::size_t offset) {
  const std::size_t size = image.data.size() - std::min(offset, image.data.size());
  try {
    return decodeImage(image.data.data() + image.data.size() - size, size);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("a compressed image of format {} cannot be decoded: {}",
                                            quoted(image.format), error.what()));
  }
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

/// 16 bits behind a DepthHeader.
cv::Mat depthPixels(const sensor_msgs::CompressedImage& image) {
  const std::uint8_t* const data = image.data.data() + sizeof(DepthHeader);
  if (contains(image.format, "rvl") && image.data.size() > sizeof(DepthHeader))
    return decodeRvl(data, image.data.size() - sizeof(DepthHeader));
  const cv::Mat pixels = decoded(image, sizeof(DepthHeader));
  if (pixels.type() == CV_16UC1) return pixels;
  throw std::invalid_argument(fmt::format(
      "the compressed depth of format {} has pixels of type {}; expected a PNG of 16 bits, or RVL",
      quoted(image.format), cv::typeToString(pixels.type())));
}

cv_bridge::CvImage depthImage(const sensor_msgs::CompressedImage& image) {
  const cv::Mat pixels = depthPixels(image);
  if (image.format.rfind(enc::TYPE_32FC1, 0) != 0) return {image.header, enc::TYPE_16UC1, pixels};
  DepthHeader header{};
  std::memcpy(&header, image.data.data(), sizeof(header));
  return {image.header, enc::TYPE_32FC1, metres(pixels, header)};
}

/// Whether a DepthHeader comes first. Some senders name another format, so the data decide.
bool hasDepthHeader(const sensor_msgs::CompressedImage& image) {
  const auto isFile = [&image](std::size_t offset) {
    return image.data.size() > offset &&
           readEncodedImageHeader(image.data.data() + offset, image.data.size() - offset).has_value();
  };
  if (isFile(0)) return false;
  return contains(image.format, "compressedDepth") || isFile(sizeof(DepthHeader));
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
          fmt::format("a compressed image of format {} has pixels of type {}; "
                      "set the publisher's format to 8 bits a channel, or 16 bits grey",
                      quoted(format), cv::typeToString(pixels.type())));
  }
}

}  // namespace

sensor_msgs::ImagePtr decompressed(const sensor_msgs::CompressedImage& image) {
  if (hasDepthHeader(image)) return depthImage(image).toImageMsg();
  const cv::Mat pixels = decoded(image, 0);
  return cv_bridge::CvImage(image.header, encodingOf(pixels, image.format), pixels).toImageMsg();
}

}  // namespace softbody
