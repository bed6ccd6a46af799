#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "tracker/backoff.h"
#include "tracker/feature_count.h"

namespace softbody {

/// Decides which missing pieces of the body are searched for in a frame.
class PieceSearch {
 public:
  /// Call it once a frame. @param counts of each piece. @param stamp of the frame.
  /// @return for each piece, whether to search for it.
  std::vector<bool> duePieces(const std::vector<FeatureCount>& counts, Nanoseconds stamp);

  /// To be called with the result of a search. @param found for each piece.
  void markFound(const std::vector<bool>& found);

  /// To be called when the body has other pieces, too.
  void reset() { backoffs_.clear(); }

 private:
  std::vector<Backoff> backoffs_;  ///< of each piece
};

}  // namespace softbody
