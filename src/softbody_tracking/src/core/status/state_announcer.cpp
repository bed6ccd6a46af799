#include "status/state_announcer.h"

#include <fmt/format.h>

namespace softbody {
namespace {

// [s] a line of the log can be read in about this time.
constexpr double kPeriod_s = 1.0;

/// A body that is searched for again is lost.
TrackingState kindOf(TrackingState state) {
  return state == TrackingState::kRecovering ? TrackingState::kLost : state;
}

const char* wordFor(TrackingState kind) {
  if (kind == TrackingState::kTracking) return "TRACKING";
  return kind == TrackingState::kLost ? "LOST" : "DEGRADED";
}

}  // namespace

std::optional<Announcement> StateAnnouncer::announce(const TrackingStatus& status, double now_s) {
  const TrackingState kind = kindOf(status.state);
  if (kind != TrackingState::kDegraded) degraded_since_.reset();
  if (kind == said_) return std::nullopt;
  // A start, or a reset by the user: the next state is said at once.
  if (kind == TrackingState::kInitializing) return said_ = kind, std::nullopt;
  if (kind == TrackingState::kDegraded) {
    if (!degraded_since_) degraded_since_ = now_s;
    if (now_s - *degraded_since_ < kPeriod_s) return std::nullopt;
  }
  if (said_ != TrackingState::kInitializing && now_s - said_at_ < kPeriod_s) return std::nullopt;
  said_ = kind;
  said_at_ = now_s;
  return Announcement{kind != TrackingState::kTracking,
                      fmt::format("the tracking state is {}{}{}", wordFor(kind),
                                  status.reason.empty() ? "" : ": ", status.reason)};
}

}  // namespace softbody
