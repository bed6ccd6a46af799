#pragma once

#include <string>
#include <vector>

#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/bag_frames.h"

namespace softbody {

/// Parameters of every node, from one file with a section a node, as launch files take it.
struct GraphConfig {
  PairingConfig pairing;
  CameraIngestConfig ingest;
  PipelineConfig pipeline;
  std::string output_frame;  ///< empty: the colour optical frame
};

/// What a replay uses of the nodes' parameters. What concerns only a live graph is known and unused.
/// @param path of a YAML file; empty: every parameter has its default.
/// @param warnings to which the keys are added that no node knows, and those that a replay misses.
/// @throw std::invalid_argument if the file cannot be read, has a section that is no node's, or a value that
/// is not allowed.
GraphConfig readGraphConfig(const std::string& path, std::vector<std::string>* warnings);

}  // namespace softbody
