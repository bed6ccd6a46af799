#pragma once

#include <algorithm>

namespace softbody {

/// Decides in which frames to search the whole image for a missing piece: first at once, then less often
/// after each failure. In another light a piece may look different although it has not moved. Then every
/// search fails.
class SearchBackoff {
 public:
  /// Longest wait between two searches [frames]: a third of a second at 30 Hz, and a tenth of the cost.
  static constexpr int kLongestWait = 9;

  /// Call in every frame in which the piece is missing.
  /// @return whether to search in this frame; then the next wait becomes longer.
  bool isDue() {
    if (waiting_-- > 0) return false;
    waiting_ = next_wait_;
    next_wait_ = std::min(2 * next_wait_ + 1, kLongestWait);
    return true;
  }

  /// The piece was found.
  void reset() { waiting_ = 0, next_wait_ = 1; }

 private:
  int waiting_ = 0;    ///< frames until the next search
  int next_wait_ = 1;  ///< frames between the next search and the one after it
};

}  // namespace softbody
