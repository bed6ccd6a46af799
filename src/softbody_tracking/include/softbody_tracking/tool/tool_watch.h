#pragma once

#include <map>
#include <optional>
#include <string>

#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// Notices that a tool has long not been seen: it cuts nothing, and whoever holds it may not know.
class ToolWatch {
 public:
  /// A frame and what the tracker gave for it. Where stamps jump back, the time without the tool starts anew.
  /// @param reason ToolTracker::reason().
  /// @return a sentence with counts when the tool has not been seen for 5 s, and again after 10, 20, ...
  std::optional<std::string> heed(Nanoseconds stamp, const std::optional<ToolObservation>& observation,
                                  const std::string& reason);

  /// All frames in which the tool was not seen, by reason: "12 frames: ...; 3 frames: ..."; empty without
  /// any.
  std::string missed() const { return text(missed_); }

 private:
  using Counts = std::map<std::string, int>;
  static std::string text(const Counts& counts);

  Counts missed_, on_end_;            ///< frames by reason: all, and since the tool was last seen
  std::optional<Nanoseconds> since_;  ///< stamp of the first frame, or of the last with the tool
  Nanoseconds last_stamp_ = 0;
  bool ever_seen_ = false;
  double next_s_ = 0.0;  ///< without the tool, after which to say so
};

}  // namespace softbody
