#include "core/blade_queue.h"

#include <cstdlib>
#include <iterator>
#include <utility>

#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr std::size_t kMostBlades = 1000;  // that no frame comes for

}  // namespace

void BladeQueue::add(ReportedBlade blade) {
  blades_.push_back({std::move(blade), {}});
  if (blades_.size() > kMostBlades) blades_.pop_front();
}

std::size_t BladeQueue::show(Nanoseconds frame, const Place& place, ToolMask* mask) {
  const auto isNearer = [frame](const ReportedBlade& a, const ReportedBlade& b) {
    return std::abs(a.stamp - frame) < std::abs(b.stamp - frame);
  };
  std::size_t lost = 0;
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
  for (auto waiting = blades_.begin(); waiting != blades_.end();) {
    const bool too_old = frame - waiting->blade.stamp > ToolMask::kStillThere;
    if (too_old && !waiting->placed) ++lost;
    waiting = too_old ? blades_.erase(waiting) : std::next(waiting);
  }
  return lost;
}

}  // namespace softbody
