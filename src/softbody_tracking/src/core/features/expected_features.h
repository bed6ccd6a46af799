#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "features/map_feature.h"
#include "labels/labels.h"
#include "prediction/predicted_surface.h"

namespace softbody {

/// Minimum number of expected features for the share of found features to mean anything.
constexpr int kFewestExpectedFeatures = 30;

/// A feature that the frame should show.
struct ExpectedFeature {
  int feature = 0;           ///< index into FeatureMap::features()
  cv::Point2f pixel;         ///< where to look for it
  std::uint32_t piece = 0;   ///< the piece of the body that it lies on
  Eigen::Vector3d position;  ///< predicted, camera frame [m]
  Eigen::Matrix2f warp;      ///< pixels here per pixel of the image in which its patch was learned
};

/// The features on the visible surface of a prediction.
struct ExpectedFeatures {
  std::vector<ExpectedFeature> visible;  ///< not occluded
  int occluded = 0;                      ///< features behind an occluder; they are not expected

  int count() const { return static_cast<int>(visible.size()); }
  /// @param pieces for each piece, whether its features count.
  int countOn(const std::vector<bool>& pieces) const;
  /// Share of the features on visible surface that nothing occludes; 1 without features.
  double unoccludedShare() const;
};

/// Which features the rendered prediction shows, and where.
/// @param labels of the frame, for the same prediction.
ExpectedFeatures expectFeatures(const std::vector<MapFeature>& features, const Labels& labels,
                                const PredictedSurface& surface);

/// The same features, with the pixels to which the motions of the pieces move them. The predicted positions
/// do not change.
ExpectedFeatures lookedForAfter(const RigidMotions& motions, const Pinhole& camera,
                                ExpectedFeatures expected);

}  // namespace softbody
