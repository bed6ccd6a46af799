#include "softbody_bringup/injection/deliveries.h"

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

std::vector<Delivery> planDeliveries(const std::vector<Nanoseconds>& received, const DeliveryFaults& faults) {
  const std::size_t count = received.size();
  const auto chosen = [&](double share, Purpose purpose) {
    return choose(count, share, faults.seed, purpose);
  };
  const std::vector<bool> dropped = chosen(faults.drop_share, kDrop),
                          twice = chosen(faults.duplicate_share, kDuplicate),
                          swapped = chosen(faults.reorder_share, kReorder),
                          late = chosen(faults.delay_share, kDelay),
                          wrong = chosen(faults.stamp_share, kStamp);
  std::vector<Nanoseconds> times = received;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (swapped[i]) std::swap(times[i], times[i + 1]);
  }
  std::vector<Delivery> deliveries;
  for (std::size_t i = 0; i < count; ++i) {
    if (dropped[i]) continue;
    const Delivery delivery{i, times[i] + (late[i] ? nanoseconds(faults.delay_s) : 0),
                            wrong[i] ? nanoseconds(faults.stamp_s) : 0};
    deliveries.insert(deliveries.end(), twice[i] ? 2 : 1, delivery);
  }
  return deliveries;
}

}  // namespace softbody::injection
