#pragma once

#include <string>
#include <vector>

#include "softbody_recordings/injection/deliveries.h"
#include "softbody_recordings/injection/image_faults.h"

namespace softbody::injection {

/// One number that a user may set: "delay_by" in seconds is the tool's --delay-by and the node's delay_by_s.
struct FaultOption {
  std::string name, unit;  ///< unit empty: a share, or a place in the image
  double* value;
  double least, most;
  std::string words;  ///< what it is
};

/// All of them; they point into the two structs.
std::vector<FaultOption> faultOptions(DeliveryFaults* deliveries, ImageFaults* images);

}  // namespace softbody::injection
