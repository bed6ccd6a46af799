#pragma once

#include "softbody_recordings/validation/check_limits.h"
#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Stamps that are zero, repeated or go back; the recording's clock; rates and gaps.
Findings checkStamps(const RecordingFacts& facts, const CheckLimits& limits);

/// The difference between the stamps of colour and depth.
Findings checkSync(const RecordingFacts& facts, const CheckLimits& limits);

}  // namespace softbody::validation
