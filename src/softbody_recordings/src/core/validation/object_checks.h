#pragma once

#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// A body that the first frame does not show, or shows in another unit of depth. Without a trial nothing.
Findings checkObject(const RecordingFacts& facts);

}  // namespace softbody::validation
