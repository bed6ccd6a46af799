#include "validation/frame_checks.h"

#include <fmt/format.h>

namespace softbody::validation {

Findings checkFrames(const RecordingFacts& facts) {
  Findings findings;
  // The frames that are left can be tracked.
  const Severity severity = facts.frames.with_depth == 0 ? Severity::kError : Severity::kWarning;
  for (const auto& [reason, unusable] : facts.frames.unusable) {
    findings.push_back({severity, "frames", facts.color.topic,
                        fmt::format("gives {} of {} frames that cannot be used, the first is number {}: {}",
                                    unusable.count, facts.frames.frames, unusable.first, reason)});
  }
  for (const std::string& note : facts.frames.notes)
    findings.push_back({Severity::kWarning, "camera", "", note});
  return findings;
}

}  // namespace softbody::validation
