#include "features/feature_map.h"

#include <Eigen/Dense>
#include <algorithm>

#include "softbody_common/geometry/surface_binding.h"

namespace softbody {
namespace {

// Largest map, in multiples of those in view; it also holds features of sides that are out of view.
constexpr int kMostKnown = 4;
// Time [s] for which a feature must have been expected before it can be dropped.
constexpr double kTrial_s = 0.65;
// Smallest hit rate of a feature; below it is a reflection or a shadow.
constexpr double kWorstHitRate = 0.2;

}  // namespace

void FeatureMap::score(const ExpectedFeatures& expected, const std::vector<FeatureMatch>& matches,
                       const std::vector<bool>& observed, double elapsed_s) {
  const double shown_s = std::min(elapsed_s, kMemory_s);
  for (const ExpectedFeature& feature : expected.visible)
    features_[feature.feature].expected_s += observed[feature.piece] ? shown_s : 0.0;
  for (const FeatureMatch& match : matches)
    features_[match.feature].found_s += match.inlier && observed[match.association.piece] ? shown_s : 0.0;
}

int FeatureMap::room(int expected_in_view) const {
  const int known = static_cast<int>(features_.size());
  return std::max(0, std::min(most_ - expected_in_view, kMostKnown * most_ - known));
}

void FeatureMap::add(const std::vector<MapFeature>& features) {
  for (const MapFeature& feature : features) {
    features_.push_back(feature);
    features_.back().id = next_id_++;
  }
}

void FeatureMap::retire() {
  const auto hopeless = [](const MapFeature& feature) {
    return feature.expected_s >= kTrial_s && feature.hitRate() < kWorstHitRate;
  };
  features_.erase(std::remove_if(features_.begin(), features_.end(), hopeless), features_.end());
}

void FeatureMap::rebind(const TetTopology& before, const TetTopology& after) {
  std::vector<MaterialPoint> places;
  for (const MapFeature& feature : features_) places.push_back(feature.place);
  const std::vector<MaterialPoint> moved = transferPlaces(places, before, after);
  for (std::size_t f = 0; f < features_.size(); ++f) {
    MapFeature& feature = features_[f];
    const int first = feature.first.place.tet;
    if (after.rest_vertices.rows() == feature.first_vertices && first < after.tets.rows() &&
        homogeneousCorners(after, first) == feature.first_tet) {
      static_cast<FeaturePlace&>(feature) = feature.first;
      continue;
    }
    const Eigen::Matrix4d from = homogeneousCorners(before, feature.place.tet),
                          to = homogeneousCorners(after, moved[f].tet);
    if (from != to) feature.gradient = to.inverse() * from * feature.gradient;
    feature.place = moved[f];
  }
}

void FeatureMap::reset() {
  features_.clear();
  next_id_ = 0;
}

}  // namespace softbody
