#pragma once

#include <vector>

#include "features/expected_features.h"
#include "features/feature_match.h"
#include "features/map_feature.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// The ORB features known of the body, each bound to a place in the rest body.
class FeatureMap {
 public:
  explicit FeatureMap(const FeatureConfig& config) : config_(config) {}

  const std::vector<MapFeature>& features() const { return features_; }

  /// Counts for each expected feature whether it was found.
  /// @param observed of each piece; features on the others are not scored.
  void score(const ExpectedFeatures& expected, const std::vector<FeatureMatch>& matches,
             const std::vector<bool>& observed);

  /// How many features may be added in a view that shows this many expected ones.
  int room(int expected_in_view) const;

  /// Adds bound features and gives them ids.
  void add(const std::vector<MapFeature>& features);

  /// Drops features that were seldom found where they were expected.
  void retire();

  /// Takes the features to an edited body. Features on the wall of a cut stay on their side. If the edit
  /// restores the body of a feature's admission (undo), its place is restored bit by bit.
  void rebind(const TetTopology& before, const TetTopology& after);

  void reset();

 private:
  FeatureConfig config_;
  std::vector<MapFeature> features_;
  int next_id_ = 0;
};

}  // namespace softbody
