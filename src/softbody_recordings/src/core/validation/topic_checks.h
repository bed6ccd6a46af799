#pragma once

#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Missing topics, with a remedy from what the bag holds, and wrong types.
Findings checkTopics(const RecordingFacts& facts);

}  // namespace softbody::validation
