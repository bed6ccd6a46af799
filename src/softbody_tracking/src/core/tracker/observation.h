#pragma once

#include <cstddef>
#include <vector>

#include "alignment/piece_visibility.h"
#include "depth/depth_associations.h"
#include "features/feature_matching.h"
#include "outline/outline_associations.h"

namespace softbody {

/// What a frame measures of the predicted body.
struct Observation {
  std::vector<FeatureMatch> matches;    ///< inliers lie on pieces that are at least partly visible
  std::vector<ExpectedFeature> missed;  ///< expected features that were not found
  ExpectedFeatures expected;            ///< all features that the frame should show
  double visible_vertices = 0.0;        ///< of the volume, not occluded
  int expected_features = 0;            ///< on pieces that are at least partly visible
  int matched_features = 0;             ///< on the same pieces, with outliers
  DepthAssociations depth;              ///< its associations only for pieces that are well visible
  std::size_t agreeing_blocks = 0;      ///< of depth, on all pieces
  OutlineAssociations outline;          ///< of pieces that are well visible
  std::vector<Visibility> visibility;   ///< of each piece
  std::vector<bool> in_view;            ///< of each piece, see piecesInView()
  std::vector<bool> learnable;          ///< per piece: new features can be learned on it

  /// For each piece, whether it is at least so visible.
  std::vector<bool> atLeast(Visibility least) const;
};

/// Judges each piece and drops measurements that could distort it. A piece that is almost hidden loses all
/// inliers; it is held in its place. A piece that is partly visible loses depth and outline, which would
/// bend it at its rims.
/// @param seen with matches, expected, depth and outline. @param pieces predicted vertices of each piece [m].
Observation restrictedToVisible(Observation seen, const SurfaceSamples& samples,
                                const std::vector<Points>& pieces);

}  // namespace softbody
