#pragma once

#include <vector>

#include "features/expected_features.h"
#include "features/feature_match.h"
#include "features/map_feature.h"

namespace softbody {

/// All known ORB features of the body. Each is bound to a place in the rest body.
class FeatureMap {
 public:
  /// @param most features in view.
  explicit FeatureMap(int most) : most_(most) {}

  void setMost(int most) { most_ = most; }

  const std::vector<MapFeature>& features() const { return features_; }

  /// Scores for each expected feature whether it was found.
  /// @param observed for each piece; features on pieces that are not observed are not scored.
  /// @param elapsed_s since the frame before. A pause counts little: nothing was seen in it.
  void score(const ExpectedFeatures& expected, const std::vector<FeatureMatch>& matches,
             const std::vector<bool>& observed, double elapsed_s);

  /// How many features may be added if this many are expected in the view.
  int room(int expected_in_view) const;

  /// Adds bound features and gives them ids.
  void add(const std::vector<MapFeature>& features);

  /// Drops features that were seldom found where they were expected.
  void retire();

  /// Transfers the features to an edited body. Features on the wall of a cut stay on their side. An undo can
  /// restore the body in which a feature was admitted. Then its place is restored bit by bit.
  void rebind(const TetTopology& before, const TetTopology& after);

  void reset();

 private:
  int most_;
  std::vector<MapFeature> features_;
  int next_id_ = 0;
};

}  // namespace softbody
