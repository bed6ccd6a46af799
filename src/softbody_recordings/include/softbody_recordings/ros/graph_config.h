#pragma once

#include <string>
#include <vector>

#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/bag_frames.h"

namespace softbody {

/// The parameters of all nodes, from one file with a section for each node, as for the launch files.
struct GraphConfig {
  PairingConfig pairing;
  CameraIngestConfig ingest;
  double depth_scale = 0.0;  ///< see CameraTopics
  PipelineConfig pipeline;
  double robot_deviation_m = 0.003;  ///< see robotSurfaces()
  std::string output_frame;          ///< empty: the colour optical frame
  std::string blade_frame;           ///< of a tool, in place of its markers; empty: as the tool YAML says
};

/// Reads the parameters that a replay uses. Ignores parameters that concern only the live graph.
/// @param path of a YAML file; if empty, all parameters have their defaults.
/// @param warnings gets unknown keys, and keys that change the live graph but not a replay.
/// @param gripper replaces the simulator's parameter `gripper`, unless it is empty.
/// @throw std::invalid_argument if the file cannot be read, a section is not the name of a node, or a value
/// is not allowed.
GraphConfig readGraphConfig(const std::string& path, std::vector<std::string>* warnings,
                            const std::string& gripper = "");

}  // namespace softbody
