#pragma once

#include <cstddef>
#include <vector>

#include "alignment/piece_observability.h"
#include "depth/depth_associations.h"
#include "features/feature_matching.h"
#include "outline/outline_associations.h"

namespace softbody {

/// What a frame measures of the predicted body.
struct Observation {
  std::vector<FeatureMatch> matches;         ///< inliers lie on pieces with at least partial observability
  std::vector<ExpectedFeature> missed;       ///< expected features that were not found
  ExpectedFeatures expected;                 ///< all features that the frame should show
  double visible_vertices = 0.0;             ///< of the volume, not occluded
  int expected_features = 0;                 ///< on pieces with at least partial observability
  int matched_features = 0;                  ///< on the same pieces, with outliers
  DepthAssociations depth;                   ///< its associations only for pieces with good observability
  std::size_t agreeing_blocks = 0;           ///< of depth, on all pieces
  OutlineAssociations outline;               ///< of pieces with good observability
  std::vector<Observability> observability;  ///< of each piece
  std::vector<bool> in_view;                 ///< of each piece, see piecesInView()
  std::vector<bool> learnable;               ///< per piece: new features can be learned on it

  /// For each piece, whether its observability is at least this.
  std::vector<bool> atLeast(Observability least) const;
};

/// Judges each piece and drops measurements that could distort it. A piece with poor observability loses all
/// inliers; it is held in its place. A piece with partial observability loses depth and outline, which would
/// bend it at its rims.
/// @param seen with matches, expected, depth and outline. @param pieces predicted vertices of each piece [m].
Observation restrictedToObservable(Observation seen, const SurfaceSamples& samples,
                                   const std::vector<Points>& pieces);

}  // namespace softbody
