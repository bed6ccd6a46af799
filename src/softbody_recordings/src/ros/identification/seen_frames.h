#pragma once

#include <functional>
#include <vector>

#include "identification/seen_frame.h"
#include "ros/identification/recording_question.h"

namespace softbody {

/// The frames of a recording in which the body is tracked, and the wrenches, in one frame.
struct SeenRecording {
  std::string frame;  ///< fixed frame; empty: the camera's
  std::vector<SeenFrame> frames;
  std::vector<WrenchRecord> wrenches;
};

/// Tracks the body through the recording.
/// @throw std::exception if a file cannot be used, or the body is tracked in no frame.
SeenRecording readRecording(const RecordingQuestion& question, const GraphConfig& config,
                            const ObjectModel& model, const std::vector<PinRegion>& pins,
                            const std::function<void(const std::string&)>& warn,
                            const std::function<void(double)>& progress);

}  // namespace softbody
