#pragma once

#include <string>

#include "softbody_evaluation/records/surface_record.h"

namespace softbody::evaluation {

/// Reads a surface of a bag. Leaves out states with values that are not finite and states whose topology is
/// missing, and adds a note.
/// @throw std::invalid_argument with path and topic if a topic is missing or malformed, if no state is
/// usable, or if the states have more than one frame.
SurfaceRecord readSurface(const std::string& path, const std::string& topology_topic,
                          const std::string& state_topic);

}  // namespace softbody::evaluation
