#pragma once

#include <algorithm>
#include <limits>

#include "softbody_common/time/time.h"

namespace softbody {

/// A gap this short in what is seen is normal, and no search waits longer [ns]: ten frames at 30 Hz, which
/// cost a tenth.
constexpr Nanoseconds kLongestGap = 320'000'000;

/// Decides when to try again what failed: at once, then after waits that double. Searches that fail again and
/// again, as in another light, then cost little. Time is that of the frames.
class Backoff {
 public:
  /// @param longest_wait between two tries.
  explicit Backoff(Nanoseconds longest_wait = kLongestGap) : longest_wait_(longest_wait) {}

  /// Call it in every frame that could try. The wait begins in the first one after the last try, because a
  /// try itself may take a second. @param stamp of the frame.
  bool isDue(Nanoseconds stamp) {
    if (tried_) due_ = stamp + wait_;
    tried_ = false;
    return stamp >= due_;
  }

  /// It was tried without success: the next wait is longer.
  void failed() {
    wait_ = std::min(2 * wait_ + kFirstWait, longest_wait_);
    tried_ = true;
  }

  /// The next try is due at once.
  void reset() { *this = Backoff(longest_wait_); }

 private:
  /// [ns] A little less than one frame at 30 Hz, so that stamps may jitter.
  static constexpr Nanoseconds kFirstWait = 30'000'000;

  Nanoseconds longest_wait_;
  Nanoseconds wait_ = 0;
  Nanoseconds due_ = std::numeric_limits<Nanoseconds>::min();  ///< stamp of the next try
  bool tried_ = false;                                         ///< in the last frame that could try
};

}  // namespace softbody
