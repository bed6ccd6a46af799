#pragma once

#include <optional>
#include <vector>

#include "features/expected_features.h"
#include "features/feature_match.h"
#include "features/orb_extractor.h"
#include "patches/gray_pyramid.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Distance from the expected pixel up to which descriptors are matched, if patches are not found [px].
constexpr int kWideSearchPx = 64;
/// Distance from the expected pixel up to which patches are aligned [px]: from one frame to the next.
constexpr int kSearchRadius_px = 20;
/// Weight of a feature target whose patch fits: its standard deviation is 1.4 times that of weight 1.
constexpr double kFeatureWeight = 0.5;

struct FeatureMatches {
  std::vector<FeatureMatch> matches;
  std::vector<ExpectedFeature> missed;  ///< expected features whose patches were not found
};

/// Finds map features in one frame: by sub-pixel alignment of their patches around the expected pixels, and
/// by descriptors if they moved too far. The arguments must outlive it.
class FeatureMatcher {
 public:
  FeatureMatcher(const std::vector<MapFeature>& features, const RgbdFrame& frame, const GrayPyramid& image)
      : features_(features), frame_(frame), image_(image) {}

  /// Aligns the patches of all expected features.
  FeatureMatches alignAll(const ExpectedFeatures& expected) const;
  /// Aligns about the wanted number of patches, spread evenly over the expected features. @param wanted at
  /// least 1.
  FeatureMatches alignSome(const ExpectedFeatures& expected, int wanted) const;
  /// Adds the features that alignSome() left out when called with the same arguments.
  FeatureMatches alignOthers(const ExpectedFeatures& expected, int wanted, FeatureMatches found) const;

  /// The missed features that a keypoint's descriptor matches within kWideSearchPx, each aligned there.
  std::vector<FeatureMatch> matchDescriptors(const std::vector<ExpectedFeature>& missed,
                                             const std::vector<Keypoint>& keypoints) const;

 private:
  void alignOne(const ExpectedFeature& expected, FeatureMatches* found) const;
  std::optional<FeaturePatch::Alignment> alignPatch(const ExpectedFeature& expected, const cv::Point2f& start,
                                                    int coarsest_level, int radius_px) const;
  std::optional<FeatureMatch> match(const ExpectedFeature& expected, const cv::Point2f& start,
                                    int radius_px) const;

  const std::vector<MapFeature>& features_;
  const RgbdFrame& frame_;
  const GrayPyramid& image_;
};

/// A feature seen at a pixel at this depth [m]. @param expected the same feature in the prediction.
FeatureMatch matchAt(const MapFeature& feature, const ExpectedFeature& expected, const cv::Point2f& pixel,
                     double depth, const Pinhole& camera);

/// Depth at a keypoint [m]: mean over the 5x5 pixels around it, without pixels that differ from the middle
/// one by more than 2 %.
/// @return 0 at a depth edge and where depth is missing.
double featureDepth(const cv::Mat1f& depth, const cv::Point2f& pixel);

}  // namespace softbody
