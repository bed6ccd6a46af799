#include "nodes/simulator/simulator_options.h"

#include <cmath>

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_sim/constraints/gripper_description.h"

namespace softbody {
namespace {

/// Three standard deviations of the difference between a pin and a target.
double conflictLimit(double pin_accuracy_m, double target_accuracy_m) {
  return 3.0 * std::hypot(pin_accuracy_m, target_accuracy_m);
}

}  // namespace

SimulatorOptions readSimulatorOptions(const ros::NodeHandle& private_node) {
  Parameters parameters = readParameters(private_node);
  SimulatorOptions options;
  options.object = parameters.requiredText("object");
  options.scope = parameters.flag("allow_outside", false) ? FileScope::kAnywhere : FileScope::kOwnFolder;
  options.body_frame = ownFrame(parameters, "body_frame", private_node, "softbody");
  options.simulator = readSimulatorConfig(parameters);
  options.free_run_rate_hz = parameters.number("free_run_rate_hz", options.free_run_rate_hz, 0.0, 1000.0);
  options.stall_timeout_s = parameters.number("stall_timeout_s", options.stall_timeout_s, 0.0, 60.0);
  options.pins.accuracy_m = parameters.number("pin_accuracy_m", options.pins.accuracy_m, 0.0, 1.0);
  options.pins.conflict_m = conflictLimit(options.pins.accuracy_m, options.simulator.target_accuracy_m);
  options.pins.frame_timeout_s = parameters.number("frame_timeout_s", options.pins.frame_timeout_s, 0.0, 1e3);
  options.wrench_frame = parameters.text("wrench_frame", "");
  std::vector<std::string> unknown;
  options.obstacles = readObstacles(parameters, &unknown);
  options.gripper = readGripper(parameters, &options.obstacles);
  for (const std::string& key : unknown) ROS_WARN_STREAM("unknown parameter " << key << " is ignored");
  warnUnknown(parameters);
  return options;
}

SimulatedObject loadSimulatedObject(const std::string& object, FileScope scope) {
  const ObjectDescription description = loadObjectDescription(object, scope);
  SimulatedObject loaded{buildObjectModel(description), description.pins};
  for (const std::string& warning : loaded.model.warnings) ROS_WARN_STREAM(object << ": " << warning);
  return loaded;
}

}  // namespace softbody
