#include "softbody_sim/surroundings/surroundings_config.h"

#include <cmath>

#include "softbody_sim/constraints/gripper_description.h"

namespace softbody {
namespace {

/// Three standard deviations of the difference between a pin and a target.
double conflictLimit(double pin_accuracy_m, double target_accuracy_m) {
  return 3.0 * std::hypot(pin_accuracy_m, target_accuracy_m);
}

}  // namespace

SurroundingsConfig readSurroundingsConfig(Parameters& parameters, double target_accuracy_m,
                                          std::vector<std::string>* unknown) {
  SurroundingsConfig config;
  config.pins.accuracy_m = parameters.number("pin_accuracy_m", config.pins.accuracy_m, 0.0, 1.0);
  config.pins.conflict_m = conflictLimit(config.pins.accuracy_m, target_accuracy_m);
  config.pins.frame_timeout_s = parameters.number("frame_timeout_s", config.pins.frame_timeout_s, 0.0, 1e3);
  config.obstacles = readObstacles(parameters, unknown);
  if (const auto gripper = readGripper(parameters, unknown)) {
    config.gripper = gripper->space;
    config.gripper_closed = gripper->closed;
    config.obstacles.insert(config.obstacles.end(), gripper->fingers.begin(), gripper->fingers.end());
  }
  return config;
}

}  // namespace softbody
