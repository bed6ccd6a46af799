#pragma once

#include <cstdlib>
#include <deque>
#include <optional>
#include <utility>

#include "softbody_common/types.h"

namespace softbody {

/// Pairs every colour image of a recording with the depth image nearest in time, in the order in which they
/// arrive. Pointer types stand for the images.
template <typename ColorPtr, typename DepthPtr>
class FramePairer {
 public:
  struct Pair {
    Nanoseconds stamp;
    ColorPtr color;
    DepthPtr depth;  ///< null where no depth image came within the tolerance
  };

  explicit FramePairer(Nanoseconds tolerance) : tolerance_(tolerance) {}

  void addColor(Nanoseconds stamp, ColorPtr color) { colors_.emplace_back(stamp, std::move(color)); }
  void addDepth(Nanoseconds stamp, DepthPtr depth) {
    depths_.emplace_back(stamp, std::move(depth));
    if (depths_.size() > kMostWaiting) depths_.pop_front();
  }

  /// The next colour image once its depth is certain; with `finish` even if more might have come.
  std::optional<Pair> next(bool finish) {
    if (colors_.empty()) return std::nullopt;
    const auto [stamp, color] = colors_.front();
    const std::size_t nearest = nearestTo(depths_, stamp);
    const bool exact = nearest < depths_.size() && depths_[nearest].first == stamp;
    const bool overtaken = !depths_.empty() && depths_.back().first > stamp + tolerance_;
    // Depth drivers lag by a few frames at most; a stream that stays silent must not hold all colour images
    // in memory.
    const bool overdue = colors_.size() > kMostWaiting;
    if (!exact && !overtaken && !overdue && !finish) return std::nullopt;
    Pair pair{stamp, color, nullptr};
    // A depth image that fits a later colour image better is that one's: one that was dropped must not shift
    // all pairs.
    const bool near = nearest < depths_.size() && std::llabs(depths_[nearest].first - stamp) <= tolerance_;
    if (near && nearestTo(colors_, depths_[nearest].first) == 0) {
      pair.depth = depths_[nearest].second;
      depths_.erase(depths_.begin(), depths_.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
    }
    colors_.pop_front();
    return pair;
  }

 private:
  static constexpr std::size_t kMostWaiting = 30;

  /// Index of the element nearest in time, the first of equals; the size where there is none.
  template <typename Queue>
  static std::size_t nearestTo(const Queue& queue, Nanoseconds stamp) {
    std::size_t best = queue.size();
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const bool nearer =
          best == queue.size() || std::llabs(queue[i].first - stamp) < std::llabs(queue[best].first - stamp);
      if (nearer) best = i;
    }
    return best;
  }

  Nanoseconds tolerance_;
  std::deque<std::pair<Nanoseconds, ColorPtr>> colors_;
  std::deque<std::pair<Nanoseconds, DepthPtr>> depths_;
};

}  // namespace softbody
