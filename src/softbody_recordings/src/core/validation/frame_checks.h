#pragma once

#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Frames and images that replay and evaluate cannot use; what is unusual about the camera.
Findings checkFrames(const RecordingFacts& facts);

}  // namespace softbody::validation
