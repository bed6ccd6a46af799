#pragma once

#include "softbody_recordings/validation/findings.h"
#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

/// Encodings, sizes, frame ids, and whether depth is registered to colour.
Findings checkImages(const RecordingFacts& facts);

}  // namespace softbody::validation
