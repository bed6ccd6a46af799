#pragma once

#include "softbody_recordings/validation/check_limits.h"
#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Runs all checks. Errors come first. Streams that are missing or have a wrong type are not checked further.
Findings check(const RecordingFacts& facts, const CheckLimits& limits = {});

}  // namespace softbody::validation
