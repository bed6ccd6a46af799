#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "softbody_common/types.h"

namespace softbody::injection {

/// What goes wrong between the camera and the tracker. Shares are of a stream's images, 0..1: so many of
/// every 20 in a row, chosen by the seed and the image's number alone, so that a live stream and a bag meet
/// the same.
struct DeliveryFaults {
  std::uint64_t seed = 1;
  double drop_share = 0.0;       ///< never arrive
  double duplicate_share = 0.0;  ///< arrive twice
  double reorder_share = 0.0;    ///< arrive only after the next one; at most 0.5
  double delay_share = 0.0;      ///< arrive late by delay_s
  double delay_s = 0.1;
  double stamp_share = 0.0;  ///< have a stamp that is off by stamp_s
  double stamp_s = 0.1;      ///< positive: too late
};

/// What happens to one image.
struct Fate {
  int copies = 1;           ///< 0: it is dropped
  bool after_next = false;  ///< it arrives just after the next one
  Nanoseconds delay = 0;    ///< it arrives later by this
  Nanoseconds stamp_shift = 0;
};

/// @param image number in its stream, from 0.
Fate fateOf(std::size_t image, const DeliveryFaults& faults);

/// One arrival of an image.
struct Delivery {
  std::size_t image = 0;        ///< number in the stream
  Nanoseconds received = 0;     ///< when it arrives
  Nanoseconds stamp_shift = 0;  ///< what its stamp is off by
};

/// All arrivals of a stream's images, in the images' order. @param received when they arrived without fault.
std::vector<Delivery> planDeliveries(const std::vector<Nanoseconds>& received, const DeliveryFaults& faults);

/// `round(share * count)` of `count` things. @param purpose tells independent choices of one seed apart.
std::vector<bool> choose(std::size_t count, double share, std::uint64_t seed, std::uint64_t purpose);

}  // namespace softbody::injection
