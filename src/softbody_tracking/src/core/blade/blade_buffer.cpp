#include "blade/blade_buffer.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

constexpr std::size_t kMaxBlades = 1000;  // bounds the memory if no frames come
constexpr Nanoseconds kMaxLead =
    1'000'000'000;  // [ns] slow frames catch up by then, unless the clocks differ

}  // namespace

void BladeBuffer::add(ReportedBlade blade) {
  blades_.push_back({std::move(blade), {}});
  if (blades_.size() > kMaxBlades) blades_.pop_front();
}

void BladeBuffer::clear() {
  blades_.clear();
  lead_since_.reset();
}

BladeBuffer::Rejected BladeBuffer::updateMask(Nanoseconds frame, const PoseLookup& look_up, ToolMask* mask) {
  const auto isNearer = [frame](const ReportedBlade& a, const ReportedBlade& b) {
    return std::abs(a.stamp - frame) < std::abs(b.stamp - frame);
  };
  const BufferedBlade* nearest = nullptr;
  for (BufferedBlade& entry : blades_) {
    if (entry.blade.stamp - frame > ToolMask::kBladeValidity) continue;
    if (!entry.placed) {
      if (const auto T_fixed_blade = look_up(entry.blade))
        entry.placed = transformed(entry.blade.outline, *T_fixed_blade);
    }
    if (entry.placed && (nearest == nullptr || isNearer(entry.blade, nearest->blade))) nearest = &entry;
  }
  if (nearest != nullptr) mask->setBlade(nearest->blade.stamp, *nearest->placed);
  return {removeExpired(frame), leadOver(frame)};
}

std::size_t BladeBuffer::removeExpired(Nanoseconds frame) {
  std::size_t without_pose = 0;
  for (auto entry = blades_.begin(); entry != blades_.end();) {
    const bool expired = frame - entry->blade.stamp > ToolMask::kBladeValidity;
    if (expired && !entry->placed) ++without_pose;
    entry = expired ? blades_.erase(entry) : std::next(entry);
  }
  return without_pose;
}

Nanoseconds BladeBuffer::leadOver(Nanoseconds frame) {
  const auto isOlder = [](const BufferedBlade& a, const BufferedBlade& b) {
    return a.blade.stamp < b.blade.stamp;
  };
  const auto oldest = std::min_element(blades_.begin(), blades_.end(), isOlder);
  if (oldest == blades_.end() || oldest->blade.stamp - frame <= ToolMask::kBladeValidity) {
    lead_since_.reset();
    return 0;
  }
  if (!lead_since_) lead_since_ = frame;
  return frame - *lead_since_ > kMaxLead ? blades_.back().blade.stamp - frame : 0;
}

}  // namespace softbody
