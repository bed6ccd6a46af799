#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace softbody {

/// A few bytes can stand for gigabytes of pixels: 8192 by 4096 are enough.
constexpr std::uint64_t kMostEncodedPixels = std::uint64_t{1} << 25;

/// What a PNG or JPEG file says about itself before its pixels.
struct EncodedImageHeader {
  std::uint32_t width = 0, height = 0;
  int scans = 1;  ///< passes over the pixels of a progressive JPEG
};

/// Whether its pixels are too many: kMostEncodedPixels in all, kLargestImageSide a side.
bool isTooLarge(const EncodedImageHeader& header);

/// Reads no pixel. @return nullopt: neither PNG nor JPEG, or truncated.
std::optional<EncodedImageHeader> readEncodedImageHeader(const std::uint8_t* data, std::size_t size);

/// The pixels of a PNG or JPEG file, as they are. A few bytes can stand for gigabytes of pixels, so the
/// header is checked first.
/// @throw std::invalid_argument if the data is neither, is damaged, or stands for too much.
cv::Mat decodeImage(const std::uint8_t* data, std::size_t size);

}  // namespace softbody
