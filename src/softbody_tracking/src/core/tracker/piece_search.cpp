#include "tracker/piece_search.h"

namespace softbody {

std::vector<bool> PieceSearch::duePieces(const std::vector<FeatureCount>& counts, Nanoseconds stamp) {
  std::vector<bool> due(counts.size());
  backoffs_.resize(counts.size());
  for (std::size_t piece = 0; piece < counts.size(); ++piece) {
    if (counts[piece].expected < kFewestExpectedFeatures) continue;
    if (!counts[piece].isMissing()) backoffs_[piece].reset();
    due[piece] = counts[piece].isMissing() && backoffs_[piece].isDue(stamp);
    if (due[piece]) backoffs_[piece].failed();
  }
  return due;
}

void PieceSearch::markFound(const std::vector<bool>& found) {
  for (std::size_t piece = 0; piece < found.size(); ++piece)
    if (found[piece]) backoffs_[piece].reset();
}

}  // namespace softbody
