#pragma once

#include "softbody_recordings/validation/check_limits.h"
#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Depth that is missing or has a wrong unit.
Findings checkDepth(const RecordingFacts& facts, const CheckLimits& limits);

}  // namespace softbody::validation
