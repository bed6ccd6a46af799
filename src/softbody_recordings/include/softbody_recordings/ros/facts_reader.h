#pragma once

#include <functional>
#include <string>

#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Reads all headers and a sample of the depth images.
/// @param camera namespace of the camera's topics, e.g. "/camera".
/// @param progress called with the read share, 0..1.
/// @throw std::exception with the path if the file is not a readable bag.
RecordingFacts readFacts(const std::string& path, const std::string& camera,
                         const std::function<void(double)>& progress);

}  // namespace softbody::validation
