#include "validation/object_checks.h"

#include <fmt/format.h>

namespace softbody::validation {

Findings checkObject(const RecordingFacts& facts) {
  if (!facts.trial || facts.trial->first_reason.empty()) return {};
  const TrialFacts& trial = *facts.trial;
  if (trial.fitting_unit_m) {
    return {
        {Severity::kError, "depth scale", facts.depth.topic,
         fmt::format(
             "shows the body of {} in its size only if its unit is {} m, and not {} m: set depth_scale to "
             "{} (--depth-scale {}, or the parameter of camera_ingest)",
             trial.object, *trial.fitting_unit_m, trial.unit_m, *trial.fitting_unit_m,
             *trial.fitting_unit_m)}};
  }
  if (!trial.found) {
    return {{Severity::kError, "object", facts.color.topic,
             fmt::format(
                 "and depth do not show the body of {} in {} frames. The first frame must show it near its "
                 "rest shape, not moving, and free of other objects. There: {}",
                 trial.object, trial.frames, trial.first_reason)}};
  }
  return {
      {Severity::kWarning, "object", facts.color.topic,
       fmt::format("and depth show the body of {} only from frame {} on, after {:.1f} s; before, it is not "
                   "tracked. The first frame must show it near its rest shape, and not moving. There: {}",
                   trial.object, trial.frames - 1, trial.found_after_s, trial.first_reason)}};
}

}  // namespace softbody::validation
