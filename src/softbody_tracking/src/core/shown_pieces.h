#pragma once

#include <vector>

#include "association.h"
#include "feature_map.h"
#include "surface_samples.h"

namespace softbody {

/// Of each piece of a cut body, whether enough of it shows to say how it moves: a rim that is left beside the
/// blade would turn it any way. An uncut body always shows enough; the tracker's status tells how well.
std::vector<bool> shownPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                              const std::vector<FeatureMatch>& matches, std::size_t body_count);

}  // namespace softbody
