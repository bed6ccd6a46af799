#include "softbody_recordings/validation/checks.h"

#include <algorithm>

#include "validation/depth_checks.h"
#include "validation/frame_checks.h"
#include "validation/image_checks.h"
#include "validation/intrinsics_checks.h"
#include "validation/object_checks.h"
#include "validation/time_checks.h"
#include "validation/topic_checks.h"

namespace softbody::validation {

Findings check(const RecordingFacts& facts, const CheckLimits& limits) {
  Findings all;
  for (const Findings& part :
       {checkTopics(facts), checkFrames(facts), checkImages(facts), checkStamps(facts, limits),
        checkSync(facts, limits), checkDepth(facts, limits), checkIntrinsics(facts), checkObject(facts)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  const bool readable = facts.color.present() && facts.depth.present() && facts.color_info.present();
  if (usable(all) && readable && facts.frames.with_depth == 0)
    all.push_back({Severity::kError, "frames", facts.color.topic,
                   "and depth make no frame: no two of their images have the same time"});
  std::stable_partition(all.begin(), all.end(),
                        [](const Finding& f) { return f.severity == Severity::kError; });
  return all;
}

}  // namespace softbody::validation
