#pragma once

#include <functional>
#include <string>

#include "softbody_common/files/input_file.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody {

/// Searches for the body as a replay does, until it is found.
/// @param object YAML. @param progress called with the read share, 0..1.
/// @throw std::exception if a file cannot be used.
validation::TrialFacts tryObject(const std::string& bag, const BagFramesConfig& config,
                                 const std::string& object, FileScope scope,
                                 const std::function<void(double)>& progress);

}  // namespace softbody
