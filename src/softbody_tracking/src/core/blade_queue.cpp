#include "core/blade_queue.h"

#include <utility>

#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr std::size_t kMostBlades = 1000;  // that no frame comes for

}  // namespace

void BladeQueue::add(ReportedBlade blade) {
  blades_.push_back(std::move(blade));
  if (blades_.size() > kMostBlades) blades_.pop_front();
}

std::size_t BladeQueue::show(Nanoseconds frame, const Place& place, ToolMask* mask) {
  for (auto blade = blades_.rbegin(); blade != blades_.rend(); ++blade) {
    const std::optional<Eigen::Isometry3d> T_fixed_blade = place(*blade);
    if (!T_fixed_blade) continue;
    mask->see(blade->stamp, transformed(blade->outline, *T_fixed_blade));
    blades_.erase(blades_.begin(), blade.base());
    break;
  }
  std::size_t too_old = 0;
  for (; !blades_.empty() && frame - blades_.front().stamp > ToolMask::kStillThere; ++too_old)
    blades_.pop_front();
  return too_old;
}

}  // namespace softbody
