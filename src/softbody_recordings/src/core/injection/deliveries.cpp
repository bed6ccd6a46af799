#include "softbody_recordings/injection/deliveries.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace softbody::injection {
namespace {

enum Purpose : std::uint64_t { kDrop = 1, kDuplicate, kReorder, kDelay, kStamp };

/// SplitMix64 (Steele et al. 2014): the same numbers on every machine.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

constexpr std::size_t kRun = 20;
constexpr Nanoseconds kJustAfter = 1000;

/// Whether a thing of an endless stream is chosen: of every run of 20 as many as the share asks for, so that
/// at the end of a run the whole stream has its share.
bool chosenOf(std::size_t thing, double share, std::uint64_t seed, Purpose purpose) {
  const std::size_t run = thing / kRun;
  const auto until = [share](std::size_t runs) {
    return std::llround(share * static_cast<double>(kRun * runs));
  };
  const double wanted = static_cast<double>(until(run + 1) - until(run)) / kRun;
  return choose(kRun, wanted, mix(seed) ^ run, purpose)[thing % kRun];
}

Nanoseconds nanoseconds(double seconds) { return static_cast<Nanoseconds>(std::llround(1e9 * seconds)); }

}  // namespace

std::vector<bool> choose(std::size_t count, double share, std::uint64_t seed, std::uint64_t purpose) {
  std::vector<std::pair<std::uint64_t, std::size_t>> ranks(count);
  for (std::size_t i = 0; i < count; ++i) ranks[i] = {mix(mix(mix(seed) ^ purpose) ^ i), i};
  std::sort(ranks.begin(), ranks.end());
  const auto wanted = static_cast<std::size_t>(std::llround(share * static_cast<double>(count)));
  std::vector<bool> chosen(count, false);
  for (std::size_t i = 0; i < std::min(wanted, count); ++i) chosen[ranks[i].second] = true;
  return chosen;
}

Fate fateOf(std::size_t image, const DeliveryFaults& faults) {
  const auto chosen = [&](double share, Purpose purpose) {
    return chosenOf(image, share, faults.seed, purpose);
  };
  Fate fate;
  fate.copies = chosen(faults.drop_share, kDrop) ? 0 : (chosen(faults.duplicate_share, kDuplicate) ? 2 : 1);
  // Of pairs of images the first may fall behind the second: twice the share of the pairs.
  fate.after_next = image % 2 == 0 && chosenOf(image / 2, 2.0 * faults.reorder_share, faults.seed, kReorder);
  if (chosen(faults.delay_share, kDelay)) fate.delay = nanoseconds(faults.delay_s);
  if (chosen(faults.stamp_share, kStamp)) fate.stamp_shift = nanoseconds(faults.stamp_s);
  return fate;
}

std::vector<Delivery> planDeliveries(const std::vector<Nanoseconds>& received, const DeliveryFaults& faults) {
  std::vector<Delivery> deliveries;
  for (std::size_t i = 0; i < received.size(); ++i) {
    const Fate fate = fateOf(i, faults);
    const bool overtaken = fate.after_next && i + 1 < received.size();
    const Nanoseconds time = overtaken ? received[i + 1] + kJustAfter : received[i];
    deliveries.insert(deliveries.end(), static_cast<std::size_t>(fate.copies),
                      {i, time + fate.delay, fate.stamp_shift});
  }
  return deliveries;
}

}  // namespace softbody::injection
