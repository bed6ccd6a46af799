#include "softbody_tracking/stream_monitor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <limits>
#include <vector>

namespace softbody {
namespace {

constexpr std::size_t kRemembered = 30;

Nanoseconds nearestDifference(const std::deque<Nanoseconds>& a, const std::deque<Nanoseconds>& b) {
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

void StreamMonitor::arrived(Stream stream, Nanoseconds stamp) {
  std::deque<Nanoseconds>& stamps = stamps_[static_cast<std::size_t>(stream)];
  stamps.push_back(stamp);
  if (stamps.size() > kRemembered) stamps.pop_front();
}

void StreamMonitor::completed() {
  for (auto& stamps : stamps_) stamps.clear();
  unstamped_ = {};
  refusal_.clear();
}

std::string StreamMonitor::complaint(const StreamTopics& topics) const {
  std::vector<std::string> silent;
  for (std::size_t s = 0; s < topics.size(); ++s) {
    if (stamps_[s].empty()) silent.push_back(silence(topics[s], unstamped_[s]));
  }
  if (!silent.empty()) return fmt::format("no usable message on {}", fmt::join(silent, ", "));
  if (!refusal_.empty()) return refusal_;
  const auto& color = stamps_[static_cast<std::size_t>(Stream::kColor)];
  const auto& depth = stamps_[static_cast<std::size_t>(Stream::kDepth)];
  const Nanoseconds difference = nearestDifference(color, depth);
  if (difference > tolerance_) {
    return fmt::format("stamps of {} and {} differ by {:.1f} ms at least; the tolerance is {:.1f} ms",
                       topics[static_cast<std::size_t>(Stream::kColor)].name,
                       topics[static_cast<std::size_t>(Stream::kDepth)].name,
                       static_cast<double>(difference) * 1e-6, static_cast<double>(tolerance_) * 1e-6);
  }
  return "colour and depth arrive, but too slowly to make a frame";
}

}  // namespace softbody
