#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Joins the three messages of a frame, which have equal stamps. Only the frames whose messages arrived last
/// wait, so no stamp can hold up the others.
/// @tparam ImagePtr, InfoPtr pointers to messages; null: has not come.
template <typename ImagePtr, typename InfoPtr>
class FrameAssembler {
 public:
  struct Frame {
    Nanoseconds stamp = 0;
    ImagePtr color{}, depth{};
    InfoPtr info{};
  };

  /// @return the frame, if it is complete now.
  std::optional<Frame> addColor(Nanoseconds stamp, ImagePtr color) {
    frameOf(stamp).color = std::move(color);
    return takeComplete(stamp);
  }
  std::optional<Frame> addDepth(Nanoseconds stamp, ImagePtr depth) {
    frameOf(stamp).depth = std::move(depth);
    return takeComplete(stamp);
  }
  std::optional<Frame> addInfo(Nanoseconds stamp, InfoPtr info) {
    frameOf(stamp).info = std::move(info);
    return takeComplete(stamp);
  }

 private:
  static constexpr std::size_t kMostWaiting = 4;  // the three messages of a frame come close together

  auto find(Nanoseconds stamp) {
    return std::find_if(waiting_.begin(), waiting_.end(),
                        [stamp](const Frame& frame) { return frame.stamp == stamp; });
  }

  Frame& frameOf(Nanoseconds stamp) {
    if (const auto found = find(stamp); found != waiting_.end()) return *found;
    waiting_.push_back({stamp});
    if (waiting_.size() > kMostWaiting) waiting_.pop_front();
    return waiting_.back();
  }

  /// Frames that began to arrive before a complete one are given up.
  std::optional<Frame> takeComplete(Nanoseconds stamp) {
    const auto found = find(stamp);
    if (!found->color || !found->depth || !found->info) return std::nullopt;
    Frame frame = std::move(*found);
    waiting_.erase(waiting_.begin(), std::next(found));
    return frame;
  }

  std::deque<Frame> waiting_;  ///< in the order of arrival of their first messages
};

}  // namespace softbody
