#include "ros/image_pixels.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cctype>
#include <cstring>
#include <stdexcept>

#include "softbody_common/geometry/plausibility.h"

namespace enc = sensor_msgs::image_encodings;

namespace softbody {
namespace {

/// What a sender calls an encoding may be as long as a message: its beginning says enough.
std::string shown(const std::string& encoding) { return "'" + encoding.substr(0, 60) + "'"; }

int typeOf(const sensor_msgs::Image& image, const char* name) {
  try {
    const int type = cv_bridge::getCvType(usualEncoding(image.encoding));
    if (CV_MAT_CN(type) <= 4) return type;
  } catch (const std::exception&) {  // cv_bridge::Exception, or std::out_of_range of a number of channels
  }
  throw std::invalid_argument(
      fmt::format("the {} image's encoding {} is unknown", name, shown(image.encoding)));
}

/// Whether the message has a byte for every pixel. The padding of the last row may be missing.
void checkLayout(const sensor_msgs::Image& image, std::size_t row, const char* name) {
  const bool empty = image.width == 0 || image.height == 0;
  if (empty || image.width > kLargestImageSide || image.height > kLargestImageSide) {
    throw std::invalid_argument(fmt::format("the {} image has {}x{} pixels; allowed: 1 to {} a side", name,
                                            image.width, image.height, kLargestImageSide));
  }
  if (image.step >= row && image.data.size() >= std::size_t{image.step} * (image.height - 1) + row) return;
  throw std::invalid_argument(
      fmt::format("the {} image is truncated: {} bytes in rows of {} for {}x{} pixels of {}", name,
                  image.data.size(), image.step, image.width, image.height, shown(image.encoding)));
}

bool isSwapped(const sensor_msgs::Image& image) { return (image.is_bigendian != 0) != isBigEndian(); }

void swapBytes(std::size_t bytes, cv::Mat* pixels) {
  const std::size_t row = pixels->cols * pixels->elemSize();
  for (int v = 0; v < pixels->rows; ++v) {
    for (std::uint8_t* number = pixels->ptr(v); number < pixels->ptr(v) + row; number += bytes)
      std::reverse(number, number + bytes);
  }
}

}  // namespace

bool isBigEndian() {
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

std::string usualEncoding(const std::string& encoding) {
  if (encoding == enc::TYPE_8UC3) return enc::BGR8;  // as OpenCV holds colours
  if (encoding == enc::TYPE_8UC4) return enc::BGRA8;
  if (encoding == enc::TYPE_8UC1) return enc::MONO8;
  std::string small = encoding;
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  const bool colors = enc::isColor(small) || enc::isBayer(small) || enc::isMono(small);
  return colors ? small : encoding;
}

cv::Mat pixelsOf(const sensor_msgs::Image& image, const char* name) {
  const int type = typeOf(image, name);
  const std::size_t bytes = CV_ELEM_SIZE1(type), row = std::size_t{image.width} * CV_ELEM_SIZE(type);
  checkLayout(image, row, name);
  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  const bool swapped = bytes > 1 && isSwapped(image);
  if (!swapped && image.step % bytes == 0)
    return cv::Mat(height, width, type, const_cast<std::uint8_t*>(image.data.data()), image.step);
  cv::Mat pixels(height, width, type);
  for (int v = 0; v < height; ++v)
    std::memcpy(pixels.ptr(v), image.data.data() + std::size_t{image.step} * v, row);
  if (swapped) swapBytes(bytes, &pixels);
  return pixels;
}

cv::Mat pixelsAs(const sensor_msgs::Image& image, const std::string& encoding, const char* name) {
  const cv::Mat pixels = pixelsOf(image, name);
  const std::string own = usualEncoding(image.encoding);
  if (own == encoding) return pixels;
  try {
    return cv_bridge::cvtColor(boost::make_shared<cv_bridge::CvImage>(image.header, own, pixels), encoding)
        ->image;
  } catch (const std::exception& error) {  // cv_bridge::Exception, or cv::Exception from the conversion
    throw std::invalid_argument(fmt::format("the {} image's encoding {} cannot be used: {}", name,
                                            shown(image.encoding), error.what()));
  }
}

}  // namespace softbody
