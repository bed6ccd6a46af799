#pragma once

#include <functional>
#include <map>
#include <string>

#include "softbody_common/types.h"
#include "softbody_recordings/ros/bag_frames.h"

namespace softbody {

struct ReplayOptions {
  std::string input, object, output;          ///< bag, object YAML, bag
  std::string parameters, tool, journal;      ///< YAML, tool YAML, bag with cuts; empty: none
  std::string camera = "/camera";             ///< namespace of the camera's topics
  std::string topic_namespace = "/softbody";  ///< of the output topics
  std::string output_frame;                   ///< of targets and states; empty: what the parameters say
  std::string simd;                           ///< of the simulator; empty: what the parameters say
  bool timing = false;                        ///< write wall-clock stage times too
};

/// What came of a replay.
struct ReplaySummary {
  BagFramesReport read;
  int states = 0, tools = 0, cuts = 0;  ///< frames with a surface, with the tool; edits made
  int skipped = 0;                      ///< frames of which tf does not tell where the camera is
  std::string tool_missed;              ///< ToolDropoutMonitor::missedFrames()
  std::size_t pieces = 1;               ///< at the end
  std::map<TrackingState, int> frames_by_state;
  std::map<TrackingState, std::string> reasons;  ///< the last one of each state
  double milliseconds = 0.0;                     ///< of all frames
};

/// Runs the graph's cores over a bag, every frame in order. An earlier output stays as it was if it throws.
/// @param warn called with sentences. @param progress called with the share that is done (0..1).
/// @throw std::exception with a sentence if a file cannot be used, or no frame gave a surface.
ReplaySummary replay(const ReplayOptions& options, const std::function<void(const std::string&)>& warn,
                     const std::function<void(double)>& progress);

}  // namespace softbody
