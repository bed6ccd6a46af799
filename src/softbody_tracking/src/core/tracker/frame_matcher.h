#pragma once

#include <map>
#include <vector>

#include "features/feature_matching.h"

namespace softbody {

/// Follows features from frame to frame by ORB alone, as Kang et al. 2022 do. Each feature carries the
/// descriptor of the frame in which it was last an inlier, so errors add up.
class FrameMatcher {
 public:
  explicit FrameMatcher(const FeatureConfig& config) : config_(config) {}

  void setConfig(const FeatureConfig& config) { config_ = config; }

  /// Compares the descriptors of the expected features with all keypoints by brute force. A pair is taken if
  /// each is the other's nearest. Outliers are marked. @param known FeatureMap::features(). @param expected
  /// says which features can be seen; where they are expected does not matter.
  FeatureMatches match(const std::vector<MapFeature>& known, const ExpectedFeatures& expected,
                       const std::vector<Keypoint>& keypoints, const RgbdFrame& frame);

  void reset() { latest_.clear(); }

 private:
  void forgetRetired(const std::vector<MapFeature>& known);

  FeatureConfig config_;
  std::map<int, Descriptor> latest_;  ///< by the feature's id
};

}  // namespace softbody
