#pragma once

#include <vector>

#include "features/feature_matching.h"

namespace softbody {

/// Features expected in a frame, and inliers among their matches.
struct FeatureCount {
  int expected = 0;
  int found = 0;

  /// Whether so few are found that the body, or the piece, is not where it was predicted.
  bool isMissing() const;
};

/// The sum over some pieces. @param pieces for each piece, whether it counts.
FeatureCount countOn(const std::vector<bool>& pieces, const ExpectedFeatures& expected,
                     const std::vector<FeatureMatch>& matches);

/// The count of each piece.
std::vector<FeatureCount> countByPiece(std::size_t piece_count, const ExpectedFeatures& expected,
                                       const std::vector<FeatureMatch>& matches);

}  // namespace softbody
