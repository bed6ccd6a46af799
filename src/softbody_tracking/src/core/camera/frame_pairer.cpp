#include "softbody_tracking/camera/frame_pairer.h"

#include <cmath>

namespace softbody {

PairingConfig readPairingConfig(Parameters& parameters) {
  PairingConfig config;
  config.exact = parameters.choice("sync", "approximate", {"approximate", "exact"}) == "exact";
  const double tolerance_s = parameters.number("sync_tolerance_s", 1e-9 * config.tolerance, 0.0001, 1.0);
  config.tolerance = std::llround(1e9 * tolerance_s);
  config.queue_size = parameters.integer("queue_size", config.queue_size, 1, 1000);
  return config;
}

}  // namespace softbody
