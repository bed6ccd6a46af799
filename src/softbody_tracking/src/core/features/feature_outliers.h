#pragma once

#include <vector>

#include "features/feature_match.h"
#include "softbody_common/geometry/pinhole.h"

namespace softbody {

/// Sets FeatureMatch::inlier. An outlier moves differently from its neighbours on the same piece, or further
/// than a body moves in a frame. A motion that is linear in the image is fitted to the neighbours. The fit
/// starts from the motion of the whole piece, so that a group of wrong matches does not determine it.
/// Exception: twenty matches that lie together, move alike and are only a few pixels off are kept, because
/// they are a limb.
/// Across the ray, 1.5 to 4 pixels are allowed.
void markOutliers(const Pinhole& camera, std::vector<FeatureMatch>* matches);

}  // namespace softbody
