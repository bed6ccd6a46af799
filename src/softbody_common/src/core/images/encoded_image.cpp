#include "softbody_common/images/encoded_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "softbody_common/geometry/plausibility.h"

namespace softbody {
namespace {

constexpr std::uint8_t kPngStart[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                      0,    0,   0,   13,  'I',  'H',  'D',  'R'};
constexpr std::uint8_t kMarker = 0xFF, kStartOfImage = 0xD8, kStartOfScan = 0xDA;
constexpr int kMostScans = 100;  // encoders write about ten; each takes as long as a whole image

std::uint32_t bigEndian(const std::uint8_t* bytes, int count) {
  std::uint32_t value = 0;
  for (int k = 0; k < count; ++k) value = value << 8 | bytes[k];
  return value;
}

/// Frame headers are the markers C0 to CF, except for DHT, JPG and DAC.
bool isFrameHeader(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// Within compressed pixels, FF is followed by 0 or by a restart marker, so these bytes are a scan's start.
int countScans(const std::uint8_t* data, std::size_t size) {
  int scans = 0;
  for (std::size_t at = 0; at + 1 < size; ++at) scans += data[at] == kMarker && data[at + 1] == kStartOfScan;
  return scans;
}

std::optional<EncodedImageHeader> jpegHeader(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kFrameBytes = 9;  // marker, length, bits, height, width
  for (std::size_t at = 2; at + kFrameBytes <= size && data[at] == kMarker;) {
    const std::uint8_t marker = data[at + 1];
    if (marker == kMarker) {  // a fill byte
      ++at;
    } else if (isFrameHeader(marker)) {
      return EncodedImageHeader{bigEndian(data + at + 7, 2), bigEndian(data + at + 5, 2),
                                countScans(data + at, size - at)};
    } else {
      at += 2 + bigEndian(data + at + 2, 2);
    }
  }
  return std::nullopt;
}

}  // namespace

bool isTooLarge(const EncodedImageHeader& header) {
  const auto pixels = static_cast<std::uint64_t>(header.width) * header.height;
  return pixels > kMostEncodedPixels || std::max(header.width, header.height) > kLargestImageSide;
}

std::optional<EncodedImageHeader> readEncodedImageHeader(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kPngBytes = sizeof(kPngStart) + 8;
  if (size >= kPngBytes && std::equal(std::begin(kPngStart), std::end(kPngStart), data))
    return EncodedImageHeader{bigEndian(data + sizeof(kPngStart), 4),
                              bigEndian(data + sizeof(kPngStart) + 4, 4)};
  if (size > 2 && data[0] == kMarker && data[1] == kStartOfImage) return jpegHeader(data, size);
  return std::nullopt;
}

cv::Mat decodeImage(const std::uint8_t* data, std::size_t size) {
  const auto header = readEncodedImageHeader(data, size);
  if (!header) {
    throw std::invalid_argument(
        fmt::format("{} bytes are no whole PNG or JPEG; set the publisher's format to png or jpeg", size));
  }
  if (isTooLarge(*header)) {
    throw std::invalid_argument(fmt::format(
        "its {} bytes stand for {}x{} pixels; allowed: up to {} a side and {} in all; send smaller images",
        size, header->width, header->height, kLargestImageSide, kMostEncodedPixels));
  }
  if (header->scans > kMostScans) {
    throw std::invalid_argument(
        fmt::format("a JPEG of {} scans; allowed: up to {}; switch progressive off at the publisher",
                    header->scans, kMostScans));
  }
  cv::Mat image;
  try {
    if (size <= std::numeric_limits<int>::max())
      image = cv::imdecode(cv::Mat(1, static_cast<int>(size), CV_8UC1, const_cast<std::uint8_t*>(data)),
                           cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // the sentence is ours
  }
  if (image.empty()) {
    throw std::invalid_argument(
        fmt::format("its {} bytes are damaged; check the publisher and the network", size));
  }
  return image;
}

}  // namespace softbody
