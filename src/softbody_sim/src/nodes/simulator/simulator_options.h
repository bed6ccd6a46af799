#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>
#include <vector>

#include "nodes/simulator/surroundings_tracker.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/dynamics/simulator_config.h"
#include "softbody_sim/object/object_model.h"

namespace softbody {

/// The simulator node's parameters.
struct SimulatorOptions {
  std::string object;                       ///< path of the object YAML
  FileScope scope = FileScope::kOwnFolder;  ///< of the files that the object YAML names
  std::string body_frame;
  SimulatorConfig simulator;
  double free_run_rate_hz = 30.0;  ///< 0: no steps without targets
  double stall_timeout_s = 1.0;    ///< time without targets after which the simulation goes on by itself
  std::vector<ObstacleDescription> obstacles;
  PinOptions pins;
  std::string wrench_frame;          ///< of the net external wrench; empty: the frame of the targets
  std::optional<PinRegion> gripper;  ///< the space between the fingers; the fingers are obstacles
};

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
