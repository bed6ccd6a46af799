#include "softbody_tracking/tool/tool_dropout_monitor.h"

#include <fmt/format.h>

#include "softbody_common/time.h"

namespace softbody {
namespace {

constexpr double kFirstWarning_s = 5.0;  // [s] without the tool; a hand or a turn hides it for less

}  // namespace

void ToolDropoutMonitor::restart() {
  since_.reset();
  missed_in_a_row_.clear();
  ever_seen_ = false;
}

std::optional<std::string> ToolDropoutMonitor::update(Nanoseconds stamp,
                                                      const std::optional<ToolObservation>& observation,
                                                      const std::string& reason) {
  if (stamp < last_stamp_) restart();
  last_stamp_ = stamp;
  const bool seen = observation && !observation->bridged;
  if (seen || !since_) {
    since_ = stamp;
    next_warning_s_ = kFirstWarning_s;
  }
  if (seen) {
    ever_seen_ = true;
    missed_in_a_row_.clear();
    return std::nullopt;
  }
  ++missed_[reason];
  ++missed_in_a_row_[reason];
  const double missing_s = seconds(stamp - *since_);
  if (missing_s < next_warning_s_) return std::nullopt;
  while (next_warning_s_ <= missing_s) next_warning_s_ *= 2.0;
  return fmt::format("the tool has not been seen {} {:.1f} s and cuts nothing: {}",
                     ever_seen_ ? "for" : "in the first", missing_s, text(missed_in_a_row_));
}

std::string ToolDropoutMonitor::text(const Counts& counts) {
  std::string result;
  for (const auto& [reason, frames] : counts)
    result += fmt::format("{}{} frames: {}", result.empty() ? "" : "; ", frames, reason);
  return result;
}

}  // namespace softbody
