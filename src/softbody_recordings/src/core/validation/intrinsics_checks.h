#pragma once

#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// CameraInfo messages that are empty, implausible, change, or do not fit the images.
Findings checkIntrinsics(const RecordingFacts& facts);

}  // namespace softbody::validation
