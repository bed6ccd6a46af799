#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_sim/dynamics/simulator_config.h"
#include "softbody_sim/object/material_parameters.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_sim/surroundings/surroundings_config.h"

namespace softbody {

/// The simulator node's parameters.
struct SimulatorOptions {
  std::string object;          ///< path of the object YAML
  bool allow_outside = false;  ///< files that the object YAML names may be outside of its folder
  std::string body_frame;
  SimulatorConfig simulator;
  MaterialParameters material;
  double free_run_rate_hz = 30.0;  ///< 0: no steps without targets
  SurroundingsConfig surroundings;
  std::string wrench_frame;  ///< of the net external wrench; empty: the frame of the targets
};

const ParameterTable<SimulatorOptions>& simulatorNodeParameters();

/// Warns of unknown keys. @throw std::invalid_argument as Parameters does.
SimulatorOptions readSimulatorOptions(const ros::NodeHandle& private_node);

/// The object's meshes, material and pins.
struct SimulatedObject {
  ObjectModel model;
  std::vector<PinRegion> pins;
};

/// Logs the object's warnings. @throw std::invalid_argument if a file of the object cannot be used.
SimulatedObject loadSimulatedObject(const std::string& object, FileScope scope);

}  // namespace softbody
