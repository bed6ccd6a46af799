#pragma once

#include <vector>

#include "features/feature_match.h"
#include "softbody_common/pinhole.h"

namespace softbody {

/// Sets FeatureMatch::inlier. An outlier moves otherwise than its neighbours on the same piece, or further
/// than a body moves in a frame. The neighbours' motion is linear in the image; its fit starts from the
/// motion of the whole piece, so that a group of wrong matches does not determine it. Twenty matches that are
/// a few pixels off but move alike stay, if they lie together: a limb.
/// @param max_disagreement_m in any direction. Across the ray, 1.5 to 4 pixels are allowed.
void markOutliers(const Pinhole& camera, double max_disagreement_m, std::vector<FeatureMatch>* matches);

}  // namespace softbody
