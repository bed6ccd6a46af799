#pragma once

#include <functional>
#include <string>

#include "softbody_common/camera_topics.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Reads all headers and a sample of the depth images.
/// @param progress called with the read share, 0..1.
/// @throw std::exception with the path if the file is not a readable bag.
RecordingFacts readFacts(const std::string& path, const CameraTopics& camera,
                         const std::function<void(double)>& progress);

}  // namespace softbody::validation
