#pragma once

#include <vector>

#include "association.h"
#include "orb_extractor.h"
#include "predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// A feature bound to the body, with its descriptor as first seen.
struct MapFeature {
  int id = 0;
  MaterialPoint place;
  Descriptor descriptor{};
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< measured position when bound, camera frame [m]
  int predicted = 0;                                    ///< frames in which it should have been seen
  int matched = 0;                                      ///< frames in which it was
};

/// A map feature found in a frame.
struct FeatureMatch {
  int feature = 0;          ///< index into FeatureMap::features()
  int keypoint = 0;         ///< index into the frame's keypoints
  Association association;  ///< to the measured 3-D position, all three directions
  bool inlier = true;
};

/// ORB features bound to the body where they lie, matched in a window around their predicted positions.
class FeatureMap {
 public:
  explicit FeatureMap(const FeatureConfig& config) : config_(config) {}

  const std::vector<MapFeature>& features() const { return features_; }

  /// Matches with outliers marked: a match that disagrees with the median motion of its neighbourhood is one,
  /// and so is one further from its prediction than a body moves in a frame.
  std::vector<FeatureMatch> match(const RgbdFrame& frame, const std::vector<Keypoint>& keypoints,
                                  const PredictedSurface& surface);

  /// How many features the last match() expected to see.
  int expected() const { return expected_; }

  /// Binds keypoints on visible surface where no feature is, and drops features that are hardly ever found
  /// again.
  void admit(const RgbdFrame& frame, const std::vector<Keypoint>& keypoints,
             const std::vector<FeatureMatch>& matches, const PredictedSurface& surface);

  void reset();

 private:
  void retire();

  FeatureConfig config_;
  std::vector<MapFeature> features_;
  int next_id_ = 0;
  int expected_ = 0;
};

/// Depth at a keypoint [m]: mean over the 5x5 pixels that lie within 2 % of the middle one; 0 where there is
/// none.
double featureDepth(const cv::Mat1f& depth, const cv::Point2f& pixel);

}  // namespace softbody
