#pragma once

#include <vector>

#include "features/feature_match.h"
#include "prediction/association.h"
#include "prediction/surface_samples.h"

namespace softbody {

/// Fewest associations (features or blocks of depth) that determine a rigid motion reliably.
constexpr int kFewestAssociations = 12;

/// How well the measurements of a frame determine the rigid motion of a piece of a cut body.
enum class Visibility {
  kAlmostHidden,  ///< not determined: only a rim beside the blade shows, or a few features close together
  kPartly,        ///< determined but uncertain: the rigid motion of the piece is damped
  kWell           ///< determined, or an uncut body; TrackingStatus says how well that is tracked
};

/// Visibility of each piece. @param pieces vertices of each piece [m].
std::vector<Visibility> pieceVisibility(const SurfaceSamples& samples, const std::vector<Association>& depth,
                                        const std::vector<FeatureMatch>& matches,
                                        const std::vector<Points>& pieces);

/// For each piece, whether the prediction shows enough of it to track it, if nothing occludes it.
std::vector<bool> piecesInView(const SurfaceSamples& samples, std::size_t piece_count);

/// For each piece, whether the depth agrees with nearly all of its visible surface. New features can be
/// learned there, even if the piece has too few features to be tracked.
std::vector<bool> confirmedPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                                  std::size_t piece_count);

}  // namespace softbody
