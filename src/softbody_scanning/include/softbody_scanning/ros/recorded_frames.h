#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "softbody_common/camera_topics.h"
#include "softbody_scanning/key_frames/key_frame.h"
#include "softbody_scanning/motion/camera_motion.h"

namespace softbody::scanning {

/// The frames of a recording that a model is made from.
struct RecordedFrames {
  std::vector<KeyFrame> key_frames;
  int frames = 0;  ///< of the recording
  int posed = 0;   ///< of these, frames whose pose is known
  int without_depth = 0;
  std::map<std::string, int> unposed;  ///< frames without a pose, by reason
};

/// Reads a recording, finds where each frame was taken, and keeps the sharpest frames of the camera's way.
/// @param progress gets the finished share, 0..1.
/// @throw std::invalid_argument with the file if it cannot be read.
RecordedFrames readFrames(const std::string& bag, const CameraTopics& camera, CameraMotion* motion,
                          const std::function<void(double)>& progress);

}  // namespace softbody::scanning
