#pragma once

#include <functional>
#include <string>

#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Reads the camera's messages as replay does, and samples the depth images.
/// @param progress called with the read share, 0..1.
/// @throw std::exception with the path if the file is not a readable bag.
RecordingFacts readFacts(const std::string& path, const BagFramesConfig& config,
                         const std::function<void(double)>& progress);

}  // namespace softbody::validation
