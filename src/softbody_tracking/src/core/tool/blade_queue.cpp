#include "tool/blade_queue.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr std::size_t kMostBlades = 1000;        // that no frame comes for
constexpr Nanoseconds kCatchUp = 1'000'000'000;  // frames that wait or are slow come up with a blade by then

}  // namespace

void BladeQueue::add(ReportedBlade blade) {
  blades_.push_back({std::move(blade), {}});
  if (blades_.size() > kMostBlades) blades_.pop_front();
}

void BladeQueue::clear() {
  blades_.clear();
  ahead_since_.reset();
}

BladeQueue::Unused BladeQueue::show(Nanoseconds frame, const Place& place, ToolMask* mask) {
  const auto isNearer = [frame](const ReportedBlade& a, const ReportedBlade& b) {
    return std::abs(a.stamp - frame) < std::abs(b.stamp - frame);
  };
  const Waiting* nearest = nullptr;
  for (Waiting& waiting : blades_) {
    if (waiting.blade.stamp - frame > ToolMask::kStillThere) continue;
    if (!waiting.placed) {
      if (const auto T_fixed_blade = place(waiting.blade))
        waiting.placed = transformed(waiting.blade.outline, *T_fixed_blade);
    }
    if (waiting.placed && (nearest == nullptr || isNearer(waiting.blade, nearest->blade))) nearest = &waiting;
  }
  if (nearest != nullptr) mask->see(nearest->blade.stamp, *nearest->placed);
  return {forgetOld(frame), aheadOf(frame)};
}

std::size_t BladeQueue::forgetOld(Nanoseconds frame) {
  std::size_t lost = 0;
  for (auto waiting = blades_.begin(); waiting != blades_.end();) {
    const bool too_old = frame - waiting->blade.stamp > ToolMask::kStillThere;
    if (too_old && !waiting->placed) ++lost;
    waiting = too_old ? blades_.erase(waiting) : std::next(waiting);
  }
  return lost;
}

Nanoseconds BladeQueue::aheadOf(Nanoseconds frame) {
  const auto isOlder = [](const Waiting& a, const Waiting& b) { return a.blade.stamp < b.blade.stamp; };
  const auto oldest = std::min_element(blades_.begin(), blades_.end(), isOlder);
  if (oldest == blades_.end() || oldest->blade.stamp - frame <= ToolMask::kStillThere) {
    ahead_since_.reset();
    return 0;
  }
  if (!ahead_since_) ahead_since_ = frame;
  return frame - *ahead_since_ > kCatchUp ? blades_.back().blade.stamp - frame : 0;
}

}  // namespace softbody
