#pragma once

#include <cstddef>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "softbody_common/types.h"

namespace softbody {

/// Frames that wait for the mask of their stamp, and leave in the order in which they came. A frame goes
/// without when its time is up, or when the mask of a later one is there: the segmentation has left it out.
/// Stamps that jump back start anew.
template <typename Frame, typename Mask>
class MaskQueue {
 public:
  struct Ready {
    Frame frame;
    std::optional<Mask> mask;
  };

  explicit MaskQueue(double patience_s) : patience_s_(patience_s) {}

  /// @param now_s of any clock that goes forward, the same in ready().
  void addFrame(Nanoseconds stamp, Frame frame, double now_s) {
    if (stamp < newest_) {
      frames_.clear();
      masks_.erase(masks_.upper_bound(last_taken_), masks_.end());  // those before are of the new pass
      last_taken_ = stamp;
    }
    newest_ = stamp;
    frames_.push_back({stamp, now_s, std::move(frame)});
  }

  void addMask(Nanoseconds stamp, Mask mask) {
    // A little back is a segmentation that works on several frames at a time.
    if (!masks_.empty() && masks_.rbegin()->first - stamp >= kStartsAgain) masks_.clear();
    masks_[stamp] = std::move(mask);
    if (masks_.size() > kMostMasks) masks_.erase(masks_.begin());
  }

  /// The first frame, if it need not wait longer.
  std::optional<Ready> ready(double now_s) {
    if (frames_.empty()) return std::nullopt;
    const Waiting& first = frames_.front();
    const auto mask = masks_.lower_bound(first.stamp);
    const bool there = mask != masks_.end() && mask->first == first.stamp;
    if (mask == masks_.end() && now_s - first.since_s < patience_s_) return std::nullopt;
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
  static constexpr std::size_t kMostMasks = 100;  // that came before their frames
  static constexpr Nanoseconds kStartsAgain = 1'000'000'000;

  double patience_s_;
  std::deque<Waiting> frames_;
  std::map<Nanoseconds, Mask> masks_;
  Nanoseconds newest_ = 0, last_taken_ = 0;  ///< frames that came, and that left
};

}  // namespace softbody
