#include "tracker/piece_search.h"

namespace softbody {
namespace {

// Frames between two searches for a piece that is held in its place.
constexpr int kFramesBetweenPieceSearches = 10;

}  // namespace

std::vector<bool> PieceSearch::duePieces(const std::vector<FeatureCount>& counts,
                                         const std::vector<bool>& followed) {
  frames_to_held_search_ =
      frames_to_held_search_ > 0 ? frames_to_held_search_ - 1 : kFramesBetweenPieceSearches - 1;
  std::vector<bool> due(counts.size());
  backoffs_.resize(counts.size());
  for (std::size_t piece = 0; piece < counts.size(); ++piece) {
    if (counts[piece].expected < kFewestExpectedFeatures) continue;
    if (!counts[piece].isMissing())
      backoffs_[piece].reset();
    else
      due[piece] = followed[piece] ? backoffs_[piece].isDue() : frames_to_held_search_ == 0;
  }
  return due;
}

void PieceSearch::markFound(const std::vector<bool>& found) {
  for (std::size_t piece = 0; piece < found.size(); ++piece)
    if (found[piece]) backoffs_[piece].reset();
}

void PieceSearch::reset() {
  backoffs_.clear();
  frames_to_held_search_ = 0;
}

}  // namespace softbody
