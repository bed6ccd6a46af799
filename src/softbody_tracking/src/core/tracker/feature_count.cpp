#include "tracker/feature_count.h"

namespace softbody {
namespace {

// Share of the expected features, below which the piece is not there; a wrong place matches a few by chance.
constexpr double kFewestFound = 0.2;

}  // namespace

bool FeatureCount::isMissing() const { return found < kFewestFound * expected; }

FeatureCount countOn(const std::vector<bool>& pieces, const ExpectedFeatures& expected,
                     const std::vector<FeatureMatch>& matches) {
  FeatureCount count{expected.countOn(pieces), 0};
  for (const FeatureMatch& match : matches)
    count.found += match.inlier && pieces[match.association.piece] ? 1 : 0;
  return count;
}

std::vector<FeatureCount> countByPiece(std::size_t piece_count, const ExpectedFeatures& expected,
                                       const std::vector<FeatureMatch>& matches) {
  std::vector<FeatureCount> counts(piece_count);
  for (const ExpectedFeature& feature : expected.visible) ++counts[feature.piece].expected;
  for (const FeatureMatch& match : matches) counts[match.association.piece].found += match.inlier ? 1 : 0;
  return counts;
}

}  // namespace softbody
