#include "softbody_tracking/tool/tool_watch.h"

#include <fmt/format.h>

namespace softbody {
namespace {

constexpr double kLong_s = 5.0;

}  // namespace

std::optional<std::string> ToolWatch::heed(Nanoseconds stamp,
                                           const std::optional<ToolObservation>& observation,
                                           const std::string& reason) {
  if (stamp < last_stamp_) {
    since_.reset();
    on_end_.clear();
    ever_seen_ = false;
  }
  last_stamp_ = stamp;
  const bool seen = observation && !observation->bridged;
  if (seen || !since_) {
    since_ = stamp;
    next_s_ = kLong_s;
  }
  if (seen) {
    ever_seen_ = true;
    on_end_.clear();
    return std::nullopt;
  }
  ++missed_[reason];
  ++on_end_[reason];
  const double missing_s = 1e-9 * static_cast<double>(stamp - *since_);
  if (missing_s < next_s_) return std::nullopt;
  while (next_s_ <= missing_s) next_s_ *= 2.0;
  return fmt::format("the tool has not been seen {} {:.1f} s, nor cut anything: {}",
                     ever_seen_ ? "for" : "once in", missing_s, text(on_end_));
}

std::string ToolWatch::text(const Counts& counts) {
  std::string result;
  for (const auto& [reason, frames] : counts)
    result += fmt::format("{}{} frames: {}", result.empty() ? "" : "; ", frames, reason);
  return result;
}

}  // namespace softbody
