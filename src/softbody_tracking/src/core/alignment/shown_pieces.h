#pragma once

#include <vector>

#include "features/feature_map.h"
#include "prediction/association.h"
#include "prediction/surface_samples.h"

namespace softbody {

/// What a frame says of how a piece of a cut body moves.
enum class Shows {
  kHardly,   ///< a rim that is left beside the blade, or features close together, would turn it any way
  kLoosely,  ///< enough to follow it, if it is held against what measurements at its rims say
  kWell      ///< an uncut body always does; the tracker's status tells how well
};

/// Of each piece. @param pieces the vertices of each [m].
std::vector<Shows> shownPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                               const std::vector<FeatureMatch>& matches, const std::vector<Points>& pieces);

/// Of each piece, whether the prediction shows enough of it to follow it, if nothing stands before it.
std::vector<bool> predictedPieces(const SurfaceSamples& samples, std::size_t piece_count);

/// Of each piece, whether the depth confirms nearly all that the prediction shows of it. Features learnt
/// there are where they seem, even if there are too few so far to follow it.
std::vector<bool> confirmedPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                                  std::size_t piece_count);

}  // namespace softbody
