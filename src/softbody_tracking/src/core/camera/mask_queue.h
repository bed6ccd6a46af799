#pragma once

#include <cstddef>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "softbody_common/types.h"

namespace softbody {

/// Frames that wait for the mask with the same stamp. They leave in the order in which they came. A frame
/// leaves without a mask after a timeout, or when the mask of a later frame has come: the segmentation
/// skipped it. A frame with an older stamp than the last one clears the queue.
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
    if (stamp < newest_) {
      frames_.clear();
      masks_.erase(masks_.upper_bound(last_taken_),
                   masks_.end());  // earlier masks belong to the restarted bag
      last_taken_ = stamp;
    }
    newest_ = stamp;
    frames_.push_back({stamp, now_s, std::move(frame)});
  }

  void addMask(Nanoseconds stamp, Mask mask) {
    // Masks may come out of order, from a segmentation that processes several frames at a time.
    if (!masks_.empty() && masks_.rbegin()->first - stamp >= kRestartGap) masks_.clear();
    masks_[stamp] = std::move(mask);
    if (masks_.size() > kMaxMasks) masks_.erase(masks_.begin());
  }

  /// The first frame, if it does not have to wait any longer.
  std::optional<Ready> ready(double now_s) {
    if (frames_.empty()) return std::nullopt;
    const Waiting& first = frames_.front();
    const auto mask = masks_.lower_bound(first.stamp);
    const bool there = mask != masks_.end() && mask->first == first.stamp;
    if (mask == masks_.end() && now_s - first.since_s < timeout_s_) return std::nullopt;
    Ready result{std::move(frames_.front().frame), std::nullopt};
    if (there) result.mask = std::move(mask->second);
    masks_.erase(masks_.begin(), there ? std::next(mask) : mask);
    last_taken_ = first.stamp;
    frames_.pop_front();
    return result;
  }

 private:
  struct Waiting {
    Nanoseconds stamp;
    double since_s;
    Frame frame;
  };
  static constexpr std::size_t kMaxMasks = 100;  // masks without a frame; bounds the memory
  static constexpr Nanoseconds kRestartGap =
      1'000'000'000;  // [ns] a mask this much older is from a restarted bag

  double timeout_s_;
  std::deque<Waiting> frames_;
  std::map<Nanoseconds, Mask> masks_;
  Nanoseconds newest_ = 0, last_taken_ = 0;  ///< stamps of the last frame that came and of the last that left
};

}  // namespace softbody
