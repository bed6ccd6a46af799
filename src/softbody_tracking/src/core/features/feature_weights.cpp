#include "features/feature_weights.h"

#include <algorithm>

#include "statistics/median.h"

namespace softbody {
namespace {

// Share of a patch's variance that no image reproduces; keeps the median from 0 in images without noise.
constexpr double kSmallestShare = 0.01;
// At this many times the median unexplained share a match has half the weight.
constexpr double kUnusual = 2.0;
// Largest sum of the matches' weights for each visible vertex, in weights of one match.
constexpr double kPerVertex = 2.5;

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

void weighByDensity(double vertices, std::vector<FeatureMatch>* matches) {
  const auto inliers = static_cast<double>(std::count_if(
      matches->begin(), matches->end(), [](const FeatureMatch& match) { return match.inlier; }));
  if (inliers == 0.0 || vertices == 0.0) return;
  const double scale = std::min(kPerVertex * vertices / inliers, 1.0);
  for (FeatureMatch& match : *matches) match.association.weight *= scale;
}

}  // namespace softbody
