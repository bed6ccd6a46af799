#include "softbody_sim/surroundings/surroundings_config.h"

namespace softbody {
namespace {

using Config = SurroundingsConfig;

/// After the obstacles, which the gripper's fingers join.
void addGripper(Parameters& given, Config* config) {
  const auto gripper = readGripper(given.text("gripper", ""), &config->unknown);
  if (!gripper) return;
  config->gripper = gripper->space;
  config->gripper_closed = gripper->closed;
  config->obstacles.insert(config->obstacles.end(), gripper->fingers.begin(), gripper->fingers.end());
}

ParameterTable<Config> makeSurroundingsTable() {
  ParameterTable<Config> table;
  table.group("simulator");
  table.number("pin_accuracy_m", &Config::pin_accuracy_m, {0.0, 1.0}, "m",
               "standard deviation of a pin's position: calibration, robot, slip; 0: as stiff as possible");
  table.other(
      "obstacles", "[]", "list", "what the body cannot enter; see below",
      [](Parameters& given, Config* config) { config->obstacles = readObstacles(given, &config->unknown); });
  table.other("gripper", "(none)", "", "YAML of a [gripper](#gripper), or its tf frame", addGripper);
  return table;
}

}  // namespace

const ParameterTable<SurroundingsConfig>& surroundingsParameters() {
  static const ParameterTable<SurroundingsConfig> table = makeSurroundingsTable();
  return table;
}

}  // namespace softbody
