#pragma once

#include <vector>

#include "features/feature_match.h"

namespace softbody {

/// Reduces the weights of matches whose patches the image reproduces worse than is usual in this frame. Noise
/// and blur affect all patches; a partly occluded patch is found beside its true place.
void weighByAgreement(std::vector<FeatureMatch>* matches);

/// Scales the weights so that the inliers together weigh the same, many or few: a fixed weight for each
/// visible vertex. A match gets at most four times its weight, and at most kLargestTargetWeight.
/// @param vertices of the volume that are visible and not occluded.
void weighByDensity(double vertices, std::vector<FeatureMatch>* matches);

}  // namespace softbody
