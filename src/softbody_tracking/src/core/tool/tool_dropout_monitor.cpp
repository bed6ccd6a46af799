#include "softbody_tracking/tool/tool_dropout_monitor.h"

#include <fmt/format.h>

#include "softbody_common/time/time.h"

namespace softbody {
namespace {

constexpr double kFirstWarning_s = 5.0;  // [s] without the tool; a hand or a turn hides it for less
constexpr double kLookEvery_s = 1.0;     // [s] before the first warning: a single image may be blurred

}  // namespace

void ToolDropoutMonitor::restart() {
  since_.reset();
  missed_in_a_row_.clear();
  ever_seen_ = false;
  cause_.clear();
}

std::optional<std::string> ToolDropoutMonitor::update(Nanoseconds stamp,
                                                      const std::optional<ToolObservation>& observation,
                                                      const std::string& reason,
                                                      const std::function<std::string()>& look_closer) {
  if (stamp < last_stamp_) restart();
  last_stamp_ = stamp;
  const bool seen = observation && !observation->bridged && reason.empty();
  if (seen || !since_) {
    since_ = stamp;
    next_warning_s_ = kFirstWarning_s;
    next_look_s_ = kLookEvery_s;
  }
  if (seen) {
    ever_seen_ = true;
    missed_in_a_row_.clear();
    cause_.clear();
    return std::nullopt;
  }
  ++missed_[reason];
  ++missed_in_a_row_[reason];
  const double missing_s = seconds(stamp - *since_);
  if (missing_s >= next_look_s_ && reason == kNoMarkerSeen) {
    next_look_s_ = missing_s < kFirstWarning_s ? missing_s + kLookEvery_s : 2.0 * missing_s;
    const std::string cause = look_closer();
    if (!cause.empty()) cause_ = cause;
  }
  if (missing_s < next_warning_s_) return std::nullopt;
  while (next_warning_s_ <= missing_s) next_warning_s_ *= 2.0;
  return fmt::format("there is no usable pose of the tool {} {:.1f} s, so it cuts nothing: {}{}{}",
                     ever_seen_ ? "for" : "in the first", missing_s, text(missed_in_a_row_),
                     cause_.empty() ? "" : ". Probably ", cause_);
}

std::string ToolDropoutMonitor::text(const Counts& counts) {
  std::string result;
  for (const auto& [reason, frames] : counts)
    result += fmt::format("{}{} frames: {}", result.empty() ? "" : "; ", frames, reason);
  return result;
}

}  // namespace softbody
