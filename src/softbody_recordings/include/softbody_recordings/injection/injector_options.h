#pragma once

#include <cstdint>
#include <string>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_recordings/injection/deliveries.h"
#include "softbody_recordings/injection/image_faults.h"

namespace softbody::injection {

/// The parameters of the injector as a node.
struct InjectorOptions {
  std::uint64_t seed = 1;
  std::string stream = "both";  ///< with delivery faults: color, depth or both
  DeliveryFaults deliveries;
  ImageFaults images;
};

/// Those of faultOptions have their unit in the name, e.g. delay_by_s.
const ParameterTable<InjectorOptions>& injectorParameters();

}  // namespace softbody::injection
