#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::injection {

/// Faults of the delivery from the camera to the tracker. A share is a part of the stream's images, 0..1. It
/// is reached after every 20 images. The choice depends only on the seed and the image's number, so a live
/// stream and a bag get the same faults.
struct DeliveryFaults {
  std::uint64_t seed = 1;
  double drop_share = 0.0;       ///< never arrive
  double duplicate_share = 0.0;  ///< arrive twice
  double reorder_share = 0.0;    ///< arrive after the next image; at most 0.5
  double delay_share = 0.0;      ///< arrive delay_s late
  double delay_s = 0.1;
  double stamp_share = 0.0;  ///< have a stamp with an error of stamp_s
  double stamp_s = 0.1;      ///< positive: too late
};

/// The delivery faults of one image.
struct ImageDelivery {
  int copies = 1;           ///< 0: the image is dropped
  bool after_next = false;  ///< the image arrives just after the next one
  Nanoseconds delay = 0;    ///< additional delay
  Nanoseconds stamp_shift = 0;
};

/// @param image number in its stream, from 0.
ImageDelivery deliveryOf(std::size_t image, const DeliveryFaults& faults);

/// One arrival of an image.
struct Arrival {
  std::size_t image = 0;        ///< number in the stream
  Nanoseconds received = 0;     ///< time of arrival
  Nanoseconds stamp_shift = 0;  ///< error of its stamp
};

/// All arrivals of a stream's images, in the order of the images. @param received arrival times without
/// faults.
std::vector<Arrival> planArrivals(const std::vector<Nanoseconds>& received, const DeliveryFaults& faults);

/// Chooses `round(share * count)` of `count` things. @param purpose makes choices with the same seed
/// independent.
std::vector<bool> choose(std::size_t count, double share, std::uint64_t seed, std::uint64_t purpose);

}  // namespace softbody::injection
