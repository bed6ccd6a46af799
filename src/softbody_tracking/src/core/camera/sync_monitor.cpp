#include "camera/sync_monitor.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

namespace softbody {
namespace {

constexpr Nanoseconds kWindow = 3'000'000'000;  // long enough for a mean, short enough to follow the camera
constexpr std::size_t kMost = 1000;             // images of a stream, if the clock stands still

}  // namespace

void SyncMonitor::note(std::deque<Arrival>* arrivals, Nanoseconds stamp, Nanoseconds now) {
  arrivals->push_back({stamp, now});
  while (arrivals->size() > kMost || std::llabs(now - arrivals->front().time) > kWindow)
    arrivals->pop_front();
}

SyncMonitor::Offsets SyncMonitor::offsets(Nanoseconds now) const {
  const auto is_recent = [now](const Arrival& arrival) { return std::llabs(now - arrival.time) <= kWindow; };
  std::vector<Nanoseconds> depths;
  for (const Arrival& depth : depths_)
    if (is_recent(depth)) depths.push_back(depth.stamp);
  Offsets offsets;
  if (depths.empty()) return offsets;
  std::sort(depths.begin(), depths.end());
  double sum_s = 0.0;
  for (const Arrival& color : colors_) {
    const auto later = std::lower_bound(depths.begin(), depths.end(), color.stamp);
    if (later == depths.end() || !is_recent(color)) continue;
    Nanoseconds nearest = *later - color.stamp;
    if (later != depths.begin()) nearest = std::min(nearest, color.stamp - *std::prev(later));
    ++offsets.colors;
    offsets.beyond += nearest > tolerance_ ? 1 : 0;
    const double offset_s = 1e-9 * static_cast<double>(nearest);
    sum_s += offset_s;
    offsets.worst_s = std::max(offsets.worst_s, offset_s);
  }
  if (offsets.colors > 0) offsets.mean_s = sum_s / offsets.colors;
  return offsets;
}

}  // namespace softbody
