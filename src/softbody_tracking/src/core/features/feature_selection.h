#pragma once

#include <vector>

#include "features/feature_matching.h"
#include "features/map_feature.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// The mask with 0 around known features, found or missed, so that no new feature is admitted there.
cv::Mat1b withoutKnownFeatures(cv::Mat1b mask, const FeatureMatches& known);

/// Where the known features lie, for chooseCorners().
struct KnownPlaces {
  bool first_view = false;            ///< no feature is known
  std::vector<MaterialPoint> places;  ///< of the features that are expected in this view
};

/// Corners that can be bound to the body. In the first view most of them are the strongest; later they fill
/// the gaps between known features.
/// @param ranked corners away from known features, the best first. @param learnable for each piece; corners
/// on pieces that are not learnable are left out. @param gap_m see spreadStrong() and spreadOut().
std::vector<cv::KeyPoint> chooseCorners(const RgbdFrame& frame, const std::vector<cv::KeyPoint>& ranked,
                                        const PredictedSurface& surface, const std::vector<bool>& learnable,
                                        const KnownPlaces& known, int wanted, double gap_m);

/// Binds keypoints to the body where their pixels show its surface. Keypoints without depth, at grazing
/// angles or without texture are left out.
/// @param learnable for each piece; keypoints on pieces that are not learnable are left out. @param most
/// largest number of features.
/// @return features without ids.
std::vector<MapFeature> bindKeypoints(const RgbdFrame& frame, const GrayPyramid& image,
                                      const std::vector<Keypoint>& keypoints, const PredictedSurface& surface,
                                      const std::vector<bool>& learnable, int most);

}  // namespace softbody
