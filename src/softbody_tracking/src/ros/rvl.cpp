#include "ros/rvl.h"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/images/encoded_image.h"

namespace softbody {
namespace {

constexpr int kMostBits = 30;  // of a number, so that shifts stay within 32 bits

/// Reads numbers of a variable length: 3 bits a group, the lowest first; the fourth says that more follow.
class GroupReader {
 public:
  GroupReader(const std::uint8_t* data, std::size_t size) : data_(data), groups_(size / 4 * 8) {}

  std::uint32_t next() {
    std::uint32_t number = 0;
    for (int bit = 0; bit < kMostBits; bit += 3) {
      const std::uint32_t group = nextGroup();
      number |= (group & 7u) << bit;
      if ((group & 8u) == 0) return number;
    }
    throw std::invalid_argument("the RVL data is damaged: a number is too long");
  }

 private:
  /// Words of 32 bits, little-endian; their highest group comes first.
  std::uint32_t nextGroup() {
    if (at_ == groups_) throw std::invalid_argument("the RVL data ends too early");
    const std::size_t byte = at_ / 8 * 4 + 3 - at_ % 8 / 2;
    const bool high = at_++ % 2 == 0;
    return high ? data_[byte] >> 4 : data_[byte] & 15u;
  }

  const std::uint8_t* data_;
  std::size_t groups_, at_ = 0;
};

cv::Mat1w emptyImage(const std::uint8_t* data, std::size_t size) {
  std::int32_t sides[2] = {0, 0};
  if (size >= sizeof(sides)) std::memcpy(sides, data, sizeof(sides));
  const auto plausible = [](std::int32_t side) {
    return side >= 1 && side <= static_cast<std::int32_t>(kLargestImageSide);
  };
  // The sides limit the memory: one group stands for any number of zeros.
  if (plausible(sides[0]) && plausible(sides[1]) &&
      std::uint64_t{1} * sides[0] * sides[1] <= kMostEncodedPixels)
    return cv::Mat1w::zeros(sides[1], sides[0]);
  throw std::invalid_argument(
      fmt::format("the RVL data is of {}x{} pixels; allowed: 1 to {} a side and {} in all", sides[0],
                  sides[1], kLargestImageSide, kMostEncodedPixels));
}

}  // namespace

cv::Mat1w decodeRvl(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kSidesBytes = 8;
  cv::Mat1w depth = emptyImage(data, size);
  GroupReader groups(data + kSidesBytes, size - kSidesBytes);
  std::uint16_t value = 0;
  for (std::size_t at = 0; at < depth.total();) {
    const std::size_t zeros = groups.next();
    const std::size_t values = groups.next();
    if (zeros > depth.total() - at || values > depth.total() - at - zeros || zeros + values == 0)
      throw std::invalid_argument("the RVL data is damaged: it has more pixels than the image");
    at += zeros;
    for (const std::size_t end = at + values; at < end; ++at) {
      const std::uint32_t number = groups.next();
      const std::uint32_t difference = (number >> 1) ^ (0u - (number & 1u));
      value = static_cast<std::uint16_t>(value + difference);
      depth.ptr<std::uint16_t>()[at] = value;
    }
  }
  return depth;
}

}  // namespace softbody
