#include "softbody_sim/ros/simulator_options.h"

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/ros_parameters.h"

namespace softbody {
namespace {

ParameterTable<SimulatorOptions> makeSimulatorNodeTable() {
  using Options = SimulatorOptions;
  ParameterTable<Options> table;
  table.group("simulator");
  table.requiredText("object", &Options::object, "object YAML");
  table.flag("allow_outside", &Options::allow_outside,
             "the object YAML may name [files in other folders](../reference.md#files-in-other-folders)");
  table.part(&Options::simulator, simulatorParameters());
  table.part(&Options::material, materialParameters());
  table
      .text("body_frame", &Options::body_frame,
            "name of the rest frame; another one if a robot's tf has it already")
      .initial = ownFrameText("softbody");
  table.number("free_run_rate_hz", &Options::free_run_rate_hz, {0.0, 1000.0}, "Hz",
               "rate of simulation while no targets come for a second; 0: never");
  table
      .text("wrench_frame", &Options::wrench_frame,
            "frame of tf in which the net [external force](#external-forces) and its torque are given")
      .initial = "that of the targets";
  table.part(&Options::surroundings, surroundingsParameters());
  return table;
}

}  // namespace

const ParameterTable<SimulatorOptions>& simulatorNodeParameters() {
  static const ParameterTable<SimulatorOptions> table = makeSimulatorNodeTable();
  return table;
}

SimulatorOptions readSimulatorOptions(const ros::NodeHandle& private_node) {
  SimulatorOptions options = readOptions(private_node, simulatorNodeParameters());
  options.body_frame = ownFrame(options.body_frame, "body_frame", private_node, "softbody");
  for (const std::string& key : options.surroundings.unknown)
    ROS_WARN_STREAM("unknown parameter " << key << " is ignored");
  return options;
}

SimulatedObject loadSimulatedObject(const std::string& object, FileScope scope) {
  const ObjectDescription description = loadObjectDescription(object, scope);
  SimulatedObject loaded{buildObjectModel(description), description.pins};
  for (const std::string& warning : loaded.model.warnings) ROS_WARN_STREAM(object << ": " << warning);
  return loaded;
}

}  // namespace softbody
