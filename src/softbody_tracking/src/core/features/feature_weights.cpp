#include "features/feature_weights.h"

#include <algorithm>

#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

// Share of a patch's variance that no image reproduces; keeps the median from 0 in images without noise.
constexpr double kSmallestShare = 0.01;
// At this many times the median unexplained share a match has half the weight.
constexpr double kUnusual = 2.0;

}  // namespace

double trustIn(const MapFeature& feature) {
  const double hits = feature.hitRate();
  return hits / (1.0 + feature.place_variance / (kUnitDeviation * kUnitDeviation));
}

void weighByAgreement(std::vector<FeatureMatch>* matches) {
  std::vector<double> shares;
  for (const FeatureMatch& match : *matches) shares.push_back(match.unexplained);
  const double usual = std::max(median(&shares), kSmallestShare);
  for (FeatureMatch& match : *matches) {
    const double ratio = match.unexplained / (kUnusual * usual);
    match.association.weight /= 1.0 + ratio * ratio;
  }
}

}  // namespace softbody
