#pragma once

#include <functional>
#include <map>
#include <string>

#include "softbody_common/protocol/camera_topics.h"
#include "softbody_scanning/scan/scanned_body.h"
#include "softbody_tracking/tool/tool_description.h"

namespace softbody::scanning {

/// From what the camera's motion is known.
enum class MotionSource { kAuto, kSheet, kTransforms, kNone };

/// "auto", "sheet", "tf" or "none".
const char* nameOf(MotionSource source);

struct RecordingOptions {
  std::string bag;
  CameraTopics camera = "/camera";
  MotionSource motion = MotionSource::kAuto;
  ToolDescription sheet;
  std::string fixed_frame;  ///< of the transforms; empty: the frame above all others
};

/// What was found out about the recording.
struct RecordingReport {
  MotionSource motion = MotionSource::kSheet;  ///< that was used
  int frames = 0;
  int posed = 0;  ///< of these, frames whose pose is known
  int key_frames = 0;
  std::map<std::string, int> unposed;  ///< frames without a pose, by reason
  double position_std_m = 0.0;         ///< of the camera relative to the object: root of the mean variance
  double depth_scale = 0.0;            ///< measured over expected depth of the table; 0: not known
};

/// Reads a recording, finds where each frame was taken, and keeps the sharpest frames of the camera's way.
/// @param progress gets the finished share, 0..1.
/// @throw std::invalid_argument with the file, and what is missing.
PosedRecording readRecording(const RecordingOptions& options, const std::function<void(double)>& progress,
                             RecordingReport* report);

}  // namespace softbody::scanning
