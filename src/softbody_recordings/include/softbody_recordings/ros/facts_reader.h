#pragma once

#include <functional>
#include <string>

#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Reads every header and a sample of the depth images. @param camera namespace of the camera's topics, e.g.
/// "/camera". @param progress is told the share that has been read (0..1).
/// @throw std::exception with its name if the file is not a readable bag.
RecordingFacts readFacts(const std::string& path, const std::string& camera,
                         const std::function<void(double)>& progress);

}  // namespace softbody::validation
