#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Frames that wait for the mask with the same stamp. They leave in the order in which they came. A frame
/// leaves without a mask after a timeout, or when the mask of a frame behind it has come: the segmentation
/// skipped it.
template <typename Frame, typename Mask>
class MaskQueue {
 public:
  struct Ready {
    Frame frame;
    std::optional<Mask> mask;
  };

  explicit MaskQueue(double timeout_s) : timeout_s_(timeout_s) {}

  /// @param now_s of any monotonic clock; ready() uses the same clock.
  void addFrame(Nanoseconds stamp, Frame frame, double now_s) {
    frames_.push_back({stamp, now_s, std::move(frame)});
  }

  /// A mask may come before its frame, and masks in any order.
  void addMask(Nanoseconds stamp, Mask mask) {
    masks_.emplace_back(stamp, std::move(mask));
    if (masks_.size() > kMaxMasks) masks_.pop_front();
  }

  /// Time has jumped back: the frames belong to the pass before.
  void forgetFrames() { frames_.clear(); }

  /// The first frame, if it does not have to wait any longer.
  std::optional<Ready> ready(double now_s) {
    if (frames_.empty()) return std::nullopt;
    const auto masked = std::find_if(frames_.begin(), frames_.end(), [this](const Waiting& frame) {
      return maskOf(frame.stamp) != masks_.end();
    });
    if (masked == frames_.end() && now_s - frames_.front().since_s < timeout_s_) return std::nullopt;
    Ready result{std::move(frames_.front().frame), std::nullopt};
    if (const auto mask = maskOf(frames_.front().stamp); mask != masks_.end()) {
      result.mask = std::move(mask->second);
      masks_.erase(mask);
    }
    frames_.pop_front();
    return result;
  }

 private:
  struct Waiting {
    Nanoseconds stamp;
    double since_s;
    Frame frame;
  };
  static constexpr std::size_t kMaxMasks = 30;  // masks of a second; bounds the memory

  /// The newest mask of a stamp.
  auto maskOf(Nanoseconds stamp) {
    auto mask = masks_.end();
    for (auto it = masks_.begin(); it != masks_.end(); ++it)
      if (it->first == stamp) mask = it;
    return mask;
  }

  double timeout_s_;
  std::deque<Waiting> frames_;
  std::deque<std::pair<Nanoseconds, Mask>> masks_;  ///< in the order of arrival
};

}  // namespace softbody
