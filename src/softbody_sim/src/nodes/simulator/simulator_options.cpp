#include "nodes/simulator/simulator_options.h"

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/ros_parameters.h"

namespace softbody {

SimulatorOptions readSimulatorOptions(const ros::NodeHandle& private_node) {
  Parameters parameters = readParameters(private_node);
  SimulatorOptions options;
  options.object = parameters.requiredText("object");
  options.scope = parameters.flag("allow_outside", false) ? FileScope::kAnywhere : FileScope::kOwnFolder;
  options.body_frame = ownFrame(parameters, "body_frame", private_node, "softbody");
  options.simulator = readSimulatorConfig(parameters);
  options.free_run_rate_hz = parameters.number("free_run_rate_hz", options.free_run_rate_hz, 0.0, 1000.0);
  options.stall_timeout_s = parameters.number("stall_timeout_s", options.stall_timeout_s, 0.0, 60.0);
  options.wrench_frame = parameters.text("wrench_frame", "");
  std::vector<std::string> unknown;
  options.surroundings = readSurroundingsConfig(parameters, options.simulator.target_accuracy_m, &unknown);
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
