#pragma once

#include <vector>

#include "features/feature_match.h"

namespace softbody {

/// Reduces the weights of matches whose patches the image reproduces worse than is usual in this frame. Noise
/// and blur affect all patches alike. But a partly occluded patch is found beside its true place.
void weighByAgreement(std::vector<FeatureMatch>* matches);

/// Scales the weights so that their sum does not depend on the number of inliers. The sum is a fixed weight
/// for each visible vertex. A match gets at most four times its weight, and at most kLargestTargetWeight.
/// @param vertices of the volume that are visible and not occluded.
void weighByDensity(double vertices, std::vector<FeatureMatch>* matches);

}  // namespace softbody
