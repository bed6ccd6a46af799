#include "softbody_tracking/camera/stream_monitor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <limits>

namespace softbody {
namespace {

constexpr std::size_t kRemembered = 30;

Nanoseconds nearestDifference(const std::vector<Nanoseconds>& a, const std::vector<Nanoseconds>& b) {
  Nanoseconds nearest = std::numeric_limits<Nanoseconds>::max();
  for (Nanoseconds x : a) {
    for (Nanoseconds y : b) nearest = std::min(nearest, std::abs(x - y));
  }
  return nearest;
}

std::string silence(const StreamTopic& topic, bool unstamped) {
  if (unstamped) return fmt::format("{} (its images have no stamp)", topic.name);
  return topic.publishers == 0 ? fmt::format("{} (nobody publishes it)", topic.name)
                               : fmt::format("{} (publishers: {}, but silent)", topic.name, topic.publishers);
}

}  // namespace

void StreamMonitor::arrived(Stream stream, Nanoseconds stamp, Nanoseconds now) {
  std::deque<Arrival>& arrivals = arrivals_[static_cast<std::size_t>(stream)];
  arrivals.push_back({stamp, now});
  if (arrivals.size() > kRemembered) arrivals.pop_front();
  came_[static_cast<std::size_t>(stream)] = true;
}

void StreamMonitor::unstamped(Stream stream) {
  unstamped_[static_cast<std::size_t>(stream)] = came_[static_cast<std::size_t>(stream)] = true;
}

void StreamMonitor::completed() {
  for (auto& arrivals : arrivals_) arrivals.clear();
  unstamped_ = {};
  refusal_.clear();
}

/// Stamps of what arrived as long ago as a stream that goes on is silent at most.
std::vector<Nanoseconds> StreamMonitor::lately(Stream stream, Nanoseconds now) const {
  std::vector<Nanoseconds> stamps;
  for (const Arrival& arrival : arrivals_[static_cast<std::size_t>(stream)])
    if (now - arrival.time <= silence_) stamps.push_back(arrival.stamp);
  return stamps;
}

/// One CameraInfo is enough: some drivers latch it.
bool StreamMonitor::isSilent(Stream stream, Nanoseconds now) const {
  return stream == Stream::kColorInfo ? !hasCome(stream) : lately(stream, now).empty();
}

std::string StreamMonitor::complaint(const StreamTopics& topics, Nanoseconds now) const {
  std::vector<std::string> silent;
  for (std::size_t s = 0; s < topics.size(); ++s) {
    if (isSilent(static_cast<Stream>(s), now)) silent.push_back(silence(topics[s], unstamped_[s]));
  }
  if (!silent.empty()) return fmt::format("no usable message on {}", fmt::join(silent, ", "));
  if (!refusal_.empty()) return refusal_;
  const Nanoseconds difference = nearestDifference(lately(Stream::kColor, now), lately(Stream::kDepth, now));
  if (difference > tolerance_) {
    return fmt::format("stamps of {} and {} differ by {:.1f} ms at least; the tolerance is {:.1f} ms",
                       topics[static_cast<std::size_t>(Stream::kColor)].name,
                       topics[static_cast<std::size_t>(Stream::kDepth)].name,
                       static_cast<double>(difference) * 1e-6, static_cast<double>(tolerance_) * 1e-6);
  }
  return "colour and depth arrive, but too slowly to make a frame";
}

}  // namespace softbody
