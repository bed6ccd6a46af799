#pragma once

#include <vector>

#include "tracker/feature_count.h"
#include "tracker/search_backoff.h"

namespace softbody {

/// Decides which missing pieces of the body are searched for in a frame.
class PieceSearch {
 public:
  /// Call it once a frame. @param counts of each piece. @param followed for each piece, whether it was
  /// tracked in the last frame. The other pieces are searched for rarely, because an occlusion may last.
  /// @return for each piece, whether to search for it.
  std::vector<bool> duePieces(const std::vector<FeatureCount>& counts, const std::vector<bool>& followed);

  /// To be called with the result of a search. @param found for each piece.
  void markFound(const std::vector<bool>& found);

  /// To be called when the body has other pieces.
  void forgetPieces() { backoffs_.clear(); }
  void reset();

 private:
  std::vector<SearchBackoff> backoffs_;  ///< of each piece that was followed
  int frames_to_held_search_ = 0;        ///< until the next search for pieces that were not followed
};

}  // namespace softbody
