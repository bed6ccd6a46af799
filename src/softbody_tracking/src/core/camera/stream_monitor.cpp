#include "camera/stream_monitor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <limits>

namespace softbody {
namespace {

/// Smallest difference between a stamp of a and a stamp of b.
Nanoseconds smallestDifference(const std::vector<Nanoseconds>& a, const std::vector<Nanoseconds>& b) {
  Nanoseconds smallest = std::numeric_limits<Nanoseconds>::max();
  for (Nanoseconds x : a) {
    for (Nanoseconds y : b) smallest = std::min(smallest, std::abs(x - y));
  }
  return smallest;
}

std::string describeSilence(const StreamTopic& topic, bool unstamped) {
  if (unstamped) return fmt::format("{} (the stamp of its images is 0)", topic.name);
  return topic.publishers == 0 ? fmt::format("{} (nobody publishes it)", topic.name)
                               : fmt::format("{} (publishers: {}, but silent)", topic.name, topic.publishers);
}

}  // namespace

void StreamMonitor::noteArrival(Stream stream, Nanoseconds stamp, Nanoseconds now) {
  std::deque<Arrival>& arrivals = arrivals_[static_cast<std::size_t>(stream)];
  arrivals.push_back({stamp, now});
  while (now - arrivals.front().time > timeout_) arrivals.pop_front();
  ever_arrived_[static_cast<std::size_t>(stream)] = true;
}

void StreamMonitor::noteUnstamped(Stream stream) {
  unstamped_[static_cast<std::size_t>(stream)] = ever_arrived_[static_cast<std::size_t>(stream)] = true;
}

void StreamMonitor::noteFrame() {
  for (auto& arrivals : arrivals_) arrivals.clear();
  unstamped_ = {};
  refusal_.clear();
}

/// Stamps of the messages that arrived within the timeout.
std::vector<Nanoseconds> StreamMonitor::recentStamps(Stream stream, Nanoseconds now) const {
  std::vector<Nanoseconds> stamps;
  for (const Arrival& arrival : arrivals_[static_cast<std::size_t>(stream)])
    if (now - arrival.time <= timeout_) stamps.push_back(arrival.stamp);
  return stamps;
}

/// For CameraInfo one message at any time is enough, because some drivers latch it.
bool StreamMonitor::isSilent(Stream stream, Nanoseconds now) const {
  return stream == Stream::kColorInfo ? !hasArrived(stream) : recentStamps(stream, now).empty();
}

std::vector<StreamMonitor::Silent> StreamMonitor::silentStreams(Nanoseconds now) const {
  std::vector<Silent> silent;
  for (const Stream stream : {Stream::kColor, Stream::kColorInfo, Stream::kDepth})
    if (isSilent(stream, now)) silent.push_back({stream, unstamped_[static_cast<std::size_t>(stream)]});
  return silent;
}

std::string StreamMonitor::diagnosis(const StreamTopics& topics, Nanoseconds now) const {
  std::vector<std::string> silent;
  for (const auto& [stream, unstamped] : silentStreams(now))
    silent.push_back(describeSilence(topics[static_cast<std::size_t>(stream)], unstamped));
  if (!silent.empty()) return fmt::format("no usable message on {}", fmt::join(silent, ", "));
  if (!refusal_.empty()) return refusal_;
  const Nanoseconds difference =
      smallestDifference(recentStamps(Stream::kColor, now), recentStamps(Stream::kDepth, now));
  if (difference > tolerance_) {
    return fmt::format("stamps of {} and {} differ by {:.1f} ms at least; the tolerance is {:.1f} ms",
                       topics[static_cast<std::size_t>(Stream::kColor)].name,
                       topics[static_cast<std::size_t>(Stream::kDepth)].name,
                       static_cast<double>(difference) * 1e-6, static_cast<double>(tolerance_) * 1e-6);
  }
  return "colour and depth arrive, but too slowly to make a frame";
}

}  // namespace softbody
