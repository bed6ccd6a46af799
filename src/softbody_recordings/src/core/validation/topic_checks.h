#pragma once

#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Missing topics, with a remedy that depends on the topics in the bag; and topics of a wrong type.
Findings checkTopics(const RecordingFacts& facts);

}  // namespace softbody::validation
