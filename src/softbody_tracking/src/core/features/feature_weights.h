#pragma once

#include <vector>

#include "features/feature_match.h"
#include "features/map_feature.h"

namespace softbody {

/// Share of its weight that a match of a feature deserves. A feature that was learned on an uncertain surface
/// is bound to an uncertain place; its variance adds to that of the measurement. And a feature that is seldom
/// found where it is expected is probably another one when it is found (rule of succession).
double trustIn(const MapFeature& feature);

/// Reduces the weights of matches whose patches the image reproduces worse than is usual in this frame. Noise
/// and blur affect all patches alike. But a partly occluded patch is found beside its true place.
void weighByAgreement(std::vector<FeatureMatch>* matches);

}  // namespace softbody
