#pragma once

#include <string>
#include <vector>

#include "softbody_recordings/injection/deliveries.h"
#include "softbody_recordings/injection/image_faults.h"

namespace softbody::injection {

/// One value that a user can set. E.g. "delay_by" [s] is the tool's --delay-by and the node's delay_by_s.
struct FaultOption {
  std::string name, unit;  ///< the unit is empty for a share or a place in the image
  double* value;
  double least, most;
  std::string description;
};

/// All options of the faults. They point into the two structs.
std::vector<FaultOption> faultOptions(DeliveryFaults* deliveries, ImageFaults* images);

}  // namespace softbody::injection
