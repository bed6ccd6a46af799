#include "nodes/simulator/simulator_options.h"

#include "softbody_common/ros/ros_parameters.h"

namespace softbody {

SimulatorOptions readSimulatorOptions(const ros::NodeHandle& private_node) {
  Parameters parameters = readParameters(private_node);
  SimulatorOptions options;
  options.object = parameters.requiredText("object");
  options.body_frame = parameters.text("body_frame", "softbody");
  options.simulator = readSimulatorConfig(parameters);
  options.free_run_rate_hz = parameters.number("free_run_rate_hz", options.free_run_rate_hz, 0.0, 1000.0);
  options.stall_timeout_s = parameters.number("stall_timeout_s", options.stall_timeout_s, 0.0, 60.0);
  std::vector<std::string> unknown;
  options.obstacles = readObstacles(parameters, &unknown);
  for (const std::string& key : unknown) ROS_WARN_STREAM("unknown parameter " << key << " is ignored");
  warnUnknown(parameters);
  return options;
}

SimulatedObject loadSimulatedObject(const std::string& object) {
  const ObjectDescription description = loadObjectDescription(object);
  SimulatedObject loaded{buildObjectModel(description), description.pins};
  for (const std::string& warning : loaded.model.warnings) ROS_WARN_STREAM(object << ": " << warning);
  return loaded;
}

}  // namespace softbody
