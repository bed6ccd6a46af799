#pragma once

#include <vector>

#include "tracker/feature_count.h"
#include "tracker/search_backoff.h"

namespace softbody {

/// Decides which missing pieces of the body are searched for in a frame.
class PieceSearch {
 public:
  /// Call once a frame. @param counts of each piece. @param followed of each piece, whether it was tracked in
  /// the last frame; the others are searched for rarely, since an occlusion may last.
  /// @return of each piece, whether to search for it.
  std::vector<bool> duePieces(const std::vector<FeatureCount>& counts, const std::vector<bool>& followed);

  /// These pieces were found. @param found of each piece.
  void markFound(const std::vector<bool>& found);

  /// The body has other pieces now.
  void forgetPieces() { backoffs_.clear(); }
  void reset();

 private:
  std::vector<SearchBackoff> backoffs_;  ///< of each piece that was followed
  int frames_to_held_search_ = 0;        ///< until pieces that were not followed are searched for
};

}  // namespace softbody
