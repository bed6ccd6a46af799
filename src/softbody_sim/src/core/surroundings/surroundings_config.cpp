#include "softbody_sim/surroundings/surroundings_config.h"

#include <cmath>

namespace softbody {
namespace {

/// Three standard deviations of the difference between a pin and a target.
double conflictLimit(double pin_accuracy_m, double target_accuracy_m) {
  return 3.0 * std::hypot(pin_accuracy_m, target_accuracy_m);
}

ParameterTable<PinOptions> makePinTable() {
  ParameterTable<PinOptions> table;
  table.group("simulator");
  table.number("pin_accuracy_m", &PinOptions::accuracy_m, {0.0, 1.0}, "m",
               "standard deviation of a pin's position: calibration, robot, slip; 0: as stiff as possible");
  table.number("frame_timeout_s", &PinOptions::frame_timeout_s, {0.0, 1e3}, "s",
               "time without a pose from tf until the frame of a pin or an obstacle is faulty");
  return table;
}

ParameterTable<SurroundingsParameters> makeSurroundingsTable() {
  ParameterTable<SurroundingsParameters> table;
  table.group("simulator");
  table.part(&SurroundingsParameters::pins, makePinTable());
  table.other("obstacles", "[]", "list", "what the body cannot enter; see below",
              [](Parameters& given, SurroundingsParameters* all) {
                all->obstacles = readObstacles(given, &all->unknown);
              });
  table.part(&SurroundingsParameters::gripper, gripperParameters());
  return table;
}

}  // namespace

const ParameterTable<SurroundingsParameters>& surroundingsParameters() {
  static const ParameterTable<SurroundingsParameters> table = makeSurroundingsTable();
  return table;
}

std::vector<std::string> unknownKeys(const SurroundingsParameters& parameters) {
  std::vector<std::string> keys = parameters.unknown;
  keys.insert(keys.end(), parameters.gripper.unknown.begin(), parameters.gripper.unknown.end());
  return keys;
}

SurroundingsConfig surroundingsOf(const SurroundingsParameters& parameters, double target_accuracy_m) {
  SurroundingsConfig config{parameters.obstacles, std::nullopt, "", parameters.pins};
  config.pins.conflict_m = conflictLimit(config.pins.accuracy_m, target_accuracy_m);
  const std::optional<GripperDescription> gripper = gripperOf(parameters.gripper);
  if (!gripper) return config;
  config.gripper = gripper->space;
  config.gripper_closed = gripper->closed;
  config.obstacles.insert(config.obstacles.end(), gripper->fingers.begin(), gripper->fingers.end());
  return config;
}

}  // namespace softbody
