#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "softbody_common/types.h"

namespace softbody::injection {

/// What goes wrong between the camera and the tracker. Shares are of a stream's images, 0..1; exactly that
/// many, rounded, are chosen, by the seed alone: the same frames of colour and of depth if both have as many.
struct DeliveryFaults {
  std::uint64_t seed = 1;
  double drop_share = 0.0;       ///< never arrive
  double duplicate_share = 0.0;  ///< arrive twice
  double reorder_share = 0.0;    ///< change places with the next one
  double delay_share = 0.0;      ///< arrive late by delay_s
  double delay_s = 0.1;
  double stamp_share = 0.0;  ///< have a stamp that is off by stamp_s
  double stamp_s = 0.1;      ///< positive: too late
};

/// One arrival of an image.
struct Delivery {
  std::size_t image = 0;        ///< index in the stream
  Nanoseconds received = 0;     ///< when it arrives
  Nanoseconds stamp_shift = 0;  ///< what its stamp is off by
};

/// `round(share * count)` of `count` images. @param purpose tells independent choices of one seed apart.
std::vector<bool> choose(std::size_t count, double share, std::uint64_t seed, std::uint64_t purpose);

/// All arrivals of a stream's images, in the images' order. @param received when they arrived without fault.
std::vector<Delivery> planDeliveries(const std::vector<Nanoseconds>& received, const DeliveryFaults& faults);

}  // namespace softbody::injection
