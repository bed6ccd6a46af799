#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/types.h"
#include "softbody_recordings/ros/bag_frames.h"

namespace softbody {

struct ReplayOptions {
  std::string input, output;                ///< bags
  std::vector<std::string> objects;         ///< object YAMLs or folders, at least one
  std::string parameters, tool, journal;    ///< YAML, tool YAML, bag with cuts; empty: none
  std::string blade_frame;                  ///< in the input's tf: of the tool, in place of its markers
  std::vector<std::string> known_surfaces;  ///< namespaces of surfaces that the input also has
  std::string robot;                        ///< URDF; empty: no robot
  std::string gripper;                      ///< YAML of a gripper, or its frame; empty: from the parameters
  CameraTopics camera = "/camera";
  std::string topic_namespace =
      "/softbody";                          ///< of the output topics of one body; several: objectNamespaces()
  std::string output_frame;                 ///< of targets and states; empty: from the parameters
  std::string simd;                         ///< of the simulator; empty: from the parameters
  FileScope scope = FileScope::kOwnFolder;  ///< of the files that the YAMLs name
  double open_loop = 0.0;                   ///< last share of the images that is not used, but predicted
  bool timing = false;                      ///< also write wall-clock times of the stages
  bool labels = false;                      ///< also write what each pixel shows
  bool forces = false;                      ///< also write the external forces
  bool placed = false;                      ///< take the initial pose as it is, without a search
};

/// The outcome of a replay for one body.
struct BodySummary {
  std::string topic_namespace;
  int states = 0, tools = 0, cuts = 0;  ///< frames with a surface; frames with the tool; cuts made
  int skipped = 0;                      ///< frames without a camera pose in tf
  int predicted = 0;                    ///< frames that were not tracked, but predicted
  int failed = 0;                       ///< frames that a stage could not process
  std::string tool_missed;              ///< ToolDropoutMonitor::missedFrames() and cause()
  std::size_t pieces = 1;               ///< at the end
  std::map<TrackingState, int> frames_by_state;
  std::map<TrackingState, std::string> reasons;  ///< the last reason of each state
  double milliseconds = 0.0;                     ///< of all frames
};

/// The outcome of a replay.
struct ReplaySummary {
  BagFramesReport read;
  std::vector<BodySummary> bodies;  ///< as the objects
};

/// Runs the core code of the graph on a bag, every frame in order. If it throws, an earlier output stays
/// unchanged.
/// @param warn called with warnings. @param progress called with the finished share, 0..1.
/// @throw std::exception if a file cannot be used, or no frame gave a surface of any body.
ReplaySummary replay(const ReplayOptions& options, const std::function<void(const std::string&)>& warn,
                     const std::function<void(double)>& progress);

}  // namespace softbody
