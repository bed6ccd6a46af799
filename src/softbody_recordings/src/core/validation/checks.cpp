#include "softbody_recordings/validation/checks.h"

#include <algorithm>

#include "validation/depth_checks.h"
#include "validation/image_checks.h"
#include "validation/intrinsics_checks.h"
#include "validation/time_checks.h"
#include "validation/topic_checks.h"

namespace softbody::validation {

Findings check(const RecordingFacts& facts, const CheckLimits& limits) {
  Findings all;
  for (const Findings& part : {checkTopics(facts), checkImages(facts), checkStamps(facts, limits),
                               checkSync(facts, limits), checkDepth(facts, limits), checkIntrinsics(facts)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  std::stable_partition(all.begin(), all.end(),
                        [](const Finding& f) { return f.severity == Severity::kError; });
  return all;
}

}  // namespace softbody::validation
