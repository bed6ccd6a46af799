#pragma once

#include <cstdlib>
#include <deque>
#include <iterator>
#include <optional>
#include <utility>

#include "softbody_common/types.h"

namespace softbody {

/// Images of a recording that are in no frame.
struct LeftOutImages {
  int colors_again = 0, depths_again = 0;  ///< one of their stamp had come before
  int depths_alone = 0;                    ///< no colour image came near to them, or none has come yet
};

/// Pairs every colour image of a recording with the depth image nearest in time, in the order of their
/// stamps: an image that was recorded up to kMostLate others late takes its place. A jump back by a second or
/// more is a recording that starts again, and keeps its place. Of images with one stamp, as a driver or a
/// bag of two recordings may have them, the first counts. Pointer types stand for the images.
template <typename ColorPtr, typename DepthPtr>
class FramePairer {
 public:
  struct Pair {
    Nanoseconds stamp;
    ColorPtr color;
    DepthPtr depth;  ///< null where no depth image came within the tolerance
  };

  explicit FramePairer(Nanoseconds tolerance) : tolerance_(tolerance) {}

  void addColor(Nanoseconds stamp, ColorPtr color) {
    if (!insert(stamp, std::move(color), &colors_)) ++left_out_.colors_again;
  }
  void addDepth(Nanoseconds stamp, DepthPtr depth) {
    if (!insert(stamp, std::move(depth), &depths_)) ++left_out_.depths_again;
    if (depths_.size() <= kMostWaiting) return;
    depths_.pop_front();
    ++left_out_.depths_alone;
  }

  /// The next colour image once its depth is certain; with `finish` even if more might have come.
  std::optional<Pair> next(bool finish) {
    if (colors_.empty() || (colors_.size() <= kMostLate && !finish)) return std::nullopt;
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
      left_out_.depths_alone += static_cast<int>(nearest);
      depths_.erase(depths_.begin(), depths_.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
    }
    colors_.pop_front();
    return pair;
  }

  LeftOutImages leftOut() const {
    LeftOutImages left_out = left_out_;
    left_out.depths_alone += static_cast<int>(depths_.size());
    return left_out;
  }

 private:
  static constexpr std::size_t kMostWaiting = 30, kMostLate = 10;
  static constexpr Nanoseconds kStartsAgain = 1'000'000'000;

  /// Before those with later stamps, unless they are so much later that the recording started again. False:
  /// not at all, beside one of the same stamp.
  template <typename Queue, typename Pointer>
  static bool insert(Nanoseconds stamp, Pointer image, Queue* queue) {
    auto place = queue->end();
    while (place != queue->begin()) {
      const Nanoseconds later_by = std::prev(place)->first - stamp;
      if (later_by <= 0 || later_by >= kStartsAgain) break;
      --place;
    }
    if (place != queue->begin() && std::prev(place)->first == stamp) return false;
    queue->emplace(place, stamp, std::move(image));
    return true;
  }

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
  LeftOutImages left_out_;
  std::deque<std::pair<Nanoseconds, ColorPtr>> colors_;
  std::deque<std::pair<Nanoseconds, DepthPtr>> depths_;
};

}  // namespace softbody
