#pragma once

#include <optional>
#include <string>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A line for the log.
struct Announcement {
  bool warning = false;
  std::string sentence;
};

/// Decides which changes of the tracking state the log gets: found, lost, and tracked badly for a second. A
/// state that changes to and fro gives one line a second, and the last line is always true.
class StateAnnouncer {
 public:
  /// Call it with every status. @param now_s of a clock that does not jump.
  std::optional<Announcement> announce(const TrackingStatus& status, double now_s);

 private:
  TrackingState said_ = TrackingState::kInitializing;  ///< by the last line
  double said_at_ = 0.0;
  std::optional<double> degraded_since_;
};

}  // namespace softbody
