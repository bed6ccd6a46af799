#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "association.h"
#include "softbody_common/pinhole.h"

namespace softbody {

/// A map feature found in a frame.
struct FeatureMatch {
  int feature = 0;  ///< index into FeatureMap::features()
  cv::Point2f pixel;
  Association association;  ///< to the measured 3-D position, all three directions
  bool inlier = true;
};

/// Marks outliers: matches that disagree with the median motion of their neighbourhood by more (local
/// rigidity) [m], or are further from their prediction than a body moves in a frame.
void markOutliers(const Pinhole& camera, double max_disagreement_m, std::vector<FeatureMatch>* matches);

}  // namespace softbody
