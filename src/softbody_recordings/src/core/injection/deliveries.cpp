#include "softbody_recordings/injection/deliveries.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "softbody_common/statistics/random.h"
#include "softbody_common/time/time.h"

namespace softbody::injection {
namespace {

enum Purpose : std::uint64_t { kDrop = 1, kDuplicate, kReorder, kDelay, kStamp };

constexpr std::size_t kRun = 20;
constexpr Nanoseconds kJustAfter = 1000;

/// Whether a thing of an endless stream is chosen. At the end of every run of 20, the share of the chosen
/// things is right.
bool chosenOf(std::size_t thing, double share, std::uint64_t seed, Purpose purpose) {
  const std::size_t run = thing / kRun;
  const auto until = [share](std::size_t runs) {
    return std::llround(share * static_cast<double>(kRun * runs));
  };
  const double wanted = static_cast<double>(until(run + 1) - until(run)) / kRun;
  return choose(kRun, wanted, hash(seed) ^ run, purpose)[thing % kRun];
}

}  // namespace

std::vector<bool> choose(std::size_t count, double share, std::uint64_t seed, std::uint64_t purpose) {
  std::vector<std::pair<std::uint64_t, std::size_t>> ranks(count);
  for (std::size_t i = 0; i < count; ++i) ranks[i] = {hash(hash(seed, purpose), i), i};
  std::sort(ranks.begin(), ranks.end());
  const auto wanted = static_cast<std::size_t>(std::llround(share * static_cast<double>(count)));
  std::vector<bool> chosen(count, false);
  for (std::size_t i = 0; i < std::min(wanted, count); ++i) chosen[ranks[i].second] = true;
  return chosen;
}

ImageDelivery deliveryOf(std::size_t image, const DeliveryFaults& faults) {
  const auto chosen = [&](double share, Purpose purpose) {
    return chosenOf(image, share, faults.seed, purpose);
  };
  ImageDelivery delivery;
  delivery.copies =
      chosen(faults.drop_share, kDrop) ? 0 : (chosen(faults.duplicate_share, kDuplicate) ? 2 : 1);
  // Only the first image of a pair can be reordered, so twice the share of the pairs is.
  delivery.after_next =
      image % 2 == 0 && chosenOf(image / 2, 2.0 * faults.reorder_share, faults.seed, kReorder);
  if (chosen(faults.delay_share, kDelay)) delivery.delay = nanoseconds(faults.delay_s);
  if (chosen(faults.stamp_share, kStamp)) delivery.stamp_shift = nanoseconds(faults.stamp_s);
  return delivery;
}

std::vector<Arrival> planArrivals(const std::vector<Nanoseconds>& received, const DeliveryFaults& faults) {
  std::vector<Arrival> arrivals;
  for (std::size_t i = 0; i < received.size(); ++i) {
    const ImageDelivery delivery = deliveryOf(i, faults);
    const bool overtaken = delivery.after_next && i + 1 < received.size();
    const Nanoseconds time = overtaken ? received[i + 1] + kJustAfter : received[i];
    arrivals.insert(arrivals.end(), static_cast<std::size_t>(delivery.copies),
                    {i, time + delivery.delay, delivery.stamp_shift});
  }
  return arrivals;
}

}  // namespace softbody::injection
