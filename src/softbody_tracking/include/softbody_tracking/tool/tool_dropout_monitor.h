#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// Warns when there has been no usable pose of a tool for a long time. Then the tool does not cut, and the
/// user may not know why.
class ToolDropoutMonitor {
 public:
  /// Takes the tracker's result for the next frame. An older stamp than the last one restarts the count.
  /// @param reason ToolTracker::reason(). @param look_closer says what the image shows instead of the
  /// markers, as whyMarkersAreMissed. It is called once a second in the first seconds without a marker, then
  /// with each warning.
  /// @return a warning when the tool has not been seen for 5 s, and again after 10, 20, 40, ... s.
  std::optional<std::string> update(Nanoseconds stamp, const std::optional<ToolObservation>& observation,
                                    const std::string& reason,
                                    const std::function<std::string()>& look_closer);

  /// Number of all frames without the tool by reason, as in "12 frames: ...; 3 frames: ...". Empty
  /// without such frames.
  std::string missedFrames() const { return text(missed_); }

  /// What look_closer said last, since the tool was last seen; empty: nothing.
  const std::string& cause() const { return cause_; }

 private:
  using Counts = std::map<std::string, int>;
  static std::string text(const Counts& counts);
  void restart();

  Counts missed_, missed_in_a_row_;   ///< frames by reason: all, and since the tool was last seen
  std::optional<Nanoseconds> since_;  ///< stamp of the last frame with the tool, or of the first frame
  Nanoseconds last_stamp_ = 0;
  bool ever_seen_ = false;
  double next_warning_s_ = 0.0;  ///< time without the tool that triggers the next warning
  double next_look_s_ = 0.0;     ///< and the next closer look
  std::string cause_;
};

}  // namespace softbody
