#pragma once

#include <vector>

#include "features/feature_match.h"

namespace softbody {

/// Reduces the weights of matches whose patches the image reproduces worse than is usual in this frame. Noise
/// and blur affect all patches alike. But a partly occluded patch is found beside its true place.
void weighByAgreement(std::vector<FeatureMatch>* matches);

/// Reduces the weights of many inliers, so that their sum is at most a fixed weight for each visible vertex.
/// Few inliers keep their weights: on a body of one colour they are often wrong.
/// @param vertices of the volume that are visible and not occluded.
void weighByDensity(double vertices, std::vector<FeatureMatch>* matches);

}  // namespace softbody
