#pragma once

#include <algorithm>

namespace softbody {

/// When to search anywhere in the image for a piece that is not where it was predicted: at once, and after
/// searches in vain less and less often. Its features may have changed, by another light, and not its place.
class SearchPace {
 public:
  static constexpr int kMostBetween = 9;  ///< frames

  /// To be asked in every frame in which the piece is missed.
  bool isDue() {
    if (waiting_-- > 0) return false;
    waiting_ = between_;
    between_ = std::min(2 * between_ + 1, kMostBetween);
    return true;
  }

  /// The piece was found.
  void reset() { waiting_ = 0, between_ = 1; }

 private:
  int waiting_ = 0;
  int between_ = 1;  ///< the next search and the one after it
};

}  // namespace softbody
