#include "validation/time_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "softbody_common/statistics/median.h"
#include "softbody_common/time/timeline.h"

namespace softbody::validation {
namespace {

constexpr double kGapInIntervals = 2.5;    // two missing frames, or strong jitter
constexpr double kRateTolerance = 1e-3;    // because stamps are rounded
constexpr double kClockTolerance_s = 1.0;  // between header stamp and record time

/// A message in the bag's order, and the distance of its stamp from the last good one.
struct Place {
  std::size_t message = 0;
  Nanoseconds gap = 0;
};

/// What the graph makes of the stamps.
struct Order {
  std::size_t repeated = 0;
  std::vector<Place> back, outliers;
};

Order orderOf(const std::vector<Nanoseconds>& stamps) {
  Order order;
  Timeline timeline;
  std::vector<Place> odd;  // outliers in a row: time may have moved
  const auto drop = [&] {
    order.outliers.insert(order.outliers.end(), odd.begin(), odd.end());
    odd.clear();
  };
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const StampVerdict verdict = timeline.judge(stamps[i]);
    const Place place{i, verdict.gap};
    if (verdict.kind == StampVerdict::kRepeated) ++order.repeated;
    if (verdict.kind == StampVerdict::kInOrder || verdict.in_a_row == 1) drop();
    if (verdict.kind == StampVerdict::kOutlier) odd.push_back(place);
    if (verdict.kind == StampVerdict::kLate) order.back.push_back(place);
    if (verdict.accepted() && verdict.gap < 0) order.back.push_back(odd.empty() ? place : odd.front());
    if (verdict.accepted()) odd.clear();
  }
  drop();
  return order;
}

/// The messages whose stamps are used.
StreamFacts withUsedStamps(const StreamFacts& stream) {
  std::set<std::size_t> unused;
  for (const Place& outlier : orderOf(stream.stamps).outliers) unused.insert(outlier.message);
  StreamFacts used = stream;
  used.stamps.clear();
  used.received.clear();
  for (std::size_t i = 0; i < stream.stamps.size(); ++i) {
    if (stream.stamps[i] == 0 || unused.count(i) != 0) continue;
    used.stamps.push_back(stream.stamps[i]);
    used.received.push_back(stream.received[i]);
  }
  return used;
}

void checkOrder(const StreamFacts& stream, Findings* findings) {
  const auto zeros = std::count(stream.stamps.begin(), stream.stamps.end(), 0);
  if (zeros > 0) {
    const auto first = std::find(stream.stamps.begin(), stream.stamps.end(), 0) - stream.stamps.begin();
    const bool all = static_cast<std::size_t>(zeros) == stream.stamps.size();
    findings->push_back(
        {all ? Severity::kError : Severity::kWarning, "stamps", stream.topic,
         fmt::format(
             "has {} messages without a stamp, the first is message {}; these images are dropped; the "
             "driver must stamp every image",
             zeros, first)});
  }
  const Order order = orderOf(stream.stamps);
  if (!order.outliers.empty()) {
    findings->push_back(
        {Severity::kWarning, "stamps", stream.topic,
         fmt::format("has {} stamps far from those before and after, the first by {:+.3f} s at message {}; "
                     "these images are dropped; check the driver's clock",
                     order.outliers.size(), seconds(order.outliers.front().gap),
                     order.outliers.front().message)});
  }
  if (!order.back.empty()) {
    findings->push_back(
        {Severity::kWarning, "stamps", stream.topic,
         fmt::format("goes back in time {} times, first by {:.3f} s at message {}; after a jump of a second "
                     "or more, tracking starts again",
                     order.back.size(), -seconds(order.back.front().gap), order.back.front().message)});
  }
  if (order.repeated > 0) {
    findings->push_back(
        {Severity::kWarning, "stamps", stream.topic,
         fmt::format("repeats a stamp {} times; the driver sends images twice", order.repeated)});
  }
}

void checkClock(const StreamFacts& stream, Findings* findings) {
  std::vector<Nanoseconds> delays;
  for (std::size_t i = 0; i < stream.stamps.size(); ++i)
    delays.push_back(stream.received[i] - stream.stamps[i]);
  const double delay = seconds(medianOf(delays));
  if (std::abs(delay) <= kClockTolerance_s) return;
  findings->push_back(
      {Severity::kWarning, "clock", stream.topic,
       fmt::format(
           "was recorded {:.3f} s {} its stamps, so transforms and latencies will be wrong; synchronise the "
           "clocks, or set use_sim_time when you record a played bag",
           std::abs(delay), delay > 0.0 ? "after" : "before")});
}

/// Intervals between the different stamps, sorted.
std::vector<Nanoseconds> intervals(const std::set<Nanoseconds>& stamps) {
  std::vector<Nanoseconds> result;
  for (auto a = stamps.begin(), b = a; a != stamps.end() && ++b != stamps.end(); ++a)
    result.push_back(*b - *a);
  return result;
}

void checkRate(const StreamFacts& stream, const CheckLimits& limits, Findings* findings) {
  std::set<Nanoseconds> stamps(stream.stamps.begin(), stream.stamps.end());
  const std::vector<Nanoseconds> steps = intervals(stamps);
  if (steps.empty()) return;
  const double interval = seconds(medianOf(steps)), rate = 1.0 / interval;
  if (rate < (1.0 - kRateTolerance) * limits.slowest_rate_hz) {
    findings->push_back(
        {Severity::kWarning, "rates", stream.topic,
         fmt::format("comes at {:.1f} Hz; below {:.0f} Hz fast motion is lost; record at 30 Hz", rate,
                     limits.slowest_rate_hz)});
  }
  std::size_t gaps = 0, longest = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    gaps += seconds(steps[i]) > kGapInIntervals * interval;
    if (steps[i] > steps[longest]) longest = i;
  }
  if (gaps == 0) return;
  const Nanoseconds before =
      *std::next(stamps.begin(), static_cast<std::ptrdiff_t>(longest)) - *stamps.begin();
  findings->push_back(
      {Severity::kWarning, "gaps", stream.topic,
       fmt::format("has {} gaps at {:.1f} Hz, the longest of {:.3f} s at {:.2f} s; the disk or the "
                   "network was too slow; record with lz4, or fewer topics",
                   gaps, rate, seconds(steps[longest]), seconds(before))});
}

void checkLength(const StreamFacts& stream, const CheckLimits& limits, Findings* findings) {
  const auto [first, last] = std::minmax_element(stream.stamps.begin(), stream.stamps.end());
  if (seconds(*last - *first) >= limits.shortest_s) return;
  findings->push_back({Severity::kWarning, "length", stream.topic,
                       fmt::format("has {} images over {:.2f} s; record {:.0f} s or more",
                                   stream.stamps.size(), seconds(*last - *first), limits.shortest_s)});
}

}  // namespace

Findings checkStamps(const RecordingFacts& facts, const CheckLimits& limits) {
  Findings findings;
  for (const StreamFacts* stream : {&facts.color, &facts.depth}) {
    if (stream->stamps.empty()) continue;
    checkOrder(*stream, &findings);
    const StreamFacts good = withUsedStamps(*stream);
    if (good.stamps.empty()) continue;
    checkClock(good, &findings);
    checkRate(good, limits, &findings);
    checkLength(good, limits, &findings);
  }
  return findings;
}

Findings checkSync(const RecordingFacts& facts, const CheckLimits& limits) {
  const std::vector<Nanoseconds> colors = withUsedStamps(facts.color).stamps,
                                 depth_stamps = withUsedStamps(facts.depth).stamps;
  const std::set<Nanoseconds> depths(depth_stamps.begin(), depth_stamps.end());
  if (depths.empty() || colors.empty()) return {};
  std::vector<Nanoseconds> offsets;
  std::size_t paired = 0;
  for (const Nanoseconds stamp : colors) {
    const auto after = depths.lower_bound(stamp);
    Nanoseconds offset = after == depths.end() ? *depths.rbegin() - stamp : *after - stamp;
    if (after != depths.begin() && std::llabs(*std::prev(after) - stamp) < std::llabs(offset))
      offset = *std::prev(after) - stamp;
    offsets.push_back(offset);
    paired += seconds(std::llabs(offset)) <= limits.sync_tolerance_s;
  }
  const double share = static_cast<double>(paired) / static_cast<double>(offsets.size());
  if (share >= 0.95) return {};
  const Severity severity = facts.frames.with_depth == 0 ? Severity::kError : Severity::kWarning;
  return {
      {severity, "sync", facts.depth.topic,
       fmt::format("has an image within {:.0f} ms of only {:.0f} % of the colour images (median {:+.1f} ms); "
                   "switch on the driver's synchronisation (enable_sync), or increase sync_tolerance_s",
                   1e3 * limits.sync_tolerance_s, 100.0 * share, 1e3 * seconds(medianOf(offsets)))}};
}

}  // namespace softbody::validation
