#include "softbody_common/time/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace softbody {

std::string whyRefused(const StampVerdict& verdict) {
  const double gap_s = seconds(std::abs(verdict.gap));
  switch (verdict.kind) {
    case StampVerdict::kUnstamped:
      return "it has no stamp; the sender must set header.stamp";
    case StampVerdict::kRepeated:
      return "its stamp is that of the last one";
    case StampVerdict::kLate:
      return fmt::format("its stamp is {:.3f} s before the last one", gap_s);
    case StampVerdict::kOutlier:
      return fmt::format("its stamp is {:.3f} s {} the last one, and alone there; check the sender's clock",
                         gap_s, verdict.gap > 0 ? "after" : "before");
    default:
      return {};
  }
}

std::optional<RefusedStamp> RefusedStamps::note(Nanoseconds stamp, const StampVerdict& verdict) {
  if (verdict.kind == StampVerdict::kOutlier) {
    odd_ = RefusedStamp{stamp, verdict};
    return std::nullopt;
  }
  if (verdict.kind == StampVerdict::kRepeated && odd_ && odd_->stamp == stamp) return std::nullopt;
  if (!verdict.accepted()) return RefusedStamp{stamp, verdict};
  const std::optional<RefusedStamp> odd = std::exchange(odd_, std::nullopt);
  return verdict.kind == StampVerdict::kInOrder ? odd : std::nullopt;
}

StampVerdict Timeline::judge(Nanoseconds stamp, std::optional<Nanoseconds> now) {
  if (stamp <= 0) return {StampVerdict::kUnstamped};
  if (now && *now <= 0) now.reset();
  if (last_ == 0) return accept(StampVerdict::kInOrder, stamp, now);
  const Nanoseconds gap = stamp - last_;
  if (gap == 0 || (run_.count > 0 && stamp == run_.last)) return {StampVerdict::kRepeated, gap};
  const bool on_time = now && accepted_at_ && stamp - *now <= lead_ + kLeap;
  if (gap > 0 && (gap <= std::max(kLeap, 2 * pace_) || on_time))
    return accept(StampVerdict::kInOrder, stamp, now);
  const Nanoseconds clock = now && accepted_at_ ? *now - *accepted_at_ : 0;
  // Half of the way, because messages come later than the clock. A clock that is corrected moves much less.
  const bool with_clock = gap < 0 && clock <= gap / 2 && std::abs(gap - clock) <= kLeap;
  if (gap < 0 && gap > -kLeap && !with_clock) return {StampVerdict::kLate, gap};
  extendRun(stamp);
  if (run_.count < kStays && !with_clock) return {StampVerdict::kOutlier, gap, run_.count};
  const bool returns = !with_clock && before_leap_ < stamp && stamp <= after_leap_ - kLeap;
  return accept(gap > 0 || returns ? StampVerdict::kMoved : StampVerdict::kJumpedBack, stamp, now);
}

/// Stamps of a slow stream are as far from each other as the first is from the stream before.
void Timeline::extendRun(Nanoseconds stamp) {
  const Nanoseconds farthest = std::max(kLeap, std::min(kSlowest, 2 * std::abs(run_.last - last_)));
  const bool follows = run_.count > 0 && stamp > run_.last && stamp - run_.last <= farthest;
  if (!follows) run_ = {0, stamp, stamp, 0};
  run_ = {run_.count + 1, run_.first, stamp, stamp - run_.last};
}

StampVerdict Timeline::accept(StampVerdict::Kind kind, Nanoseconds stamp, std::optional<Nanoseconds> now) {
  const bool in_order = kind == StampVerdict::kInOrder;
  const Nanoseconds gap = last_ == 0 ? 0 : stamp - last_;
  if (gap > kLeap) {
    before_leap_ = last_;
    after_leap_ = in_order ? stamp : run_.first;
  }
  if (kind == StampVerdict::kJumpedBack) {
    before_leap_ = after_leap_ = 0;
    ++pass_;
  }
  if (!in_order) pace_ = run_.step > kLeap ? run_.step : 0;
  if (in_order && gap <= kLeap) pace_ = 0;
  if (now) updateLead(stamp - *now, in_order && accepted_at_ ? *now - *accepted_at_ : -1);
  last_ = stamp;
  accepted_at_ = now;
  run_ = {};
  return {kind, gap};
}

/// Messages come late when a machine is busy, but never early. So the greatest lead counts, for some time.
/// @param elapsed since the last one; below 0: unknown.
void Timeline::updateLead(Nanoseconds lead, Nanoseconds elapsed) {
  constexpr Nanoseconds kFade = 10;  // a lead of one second is forgotten after ten
  lead_ = elapsed < 0 ? lead : std::max(lead, lead_ - elapsed / kFade);
}

}  // namespace softbody
