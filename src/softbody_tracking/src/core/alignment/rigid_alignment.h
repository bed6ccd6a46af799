#pragma once

#include <vector>

#include "features/feature_match.h"
#include "view/view_measurements.h"

namespace softbody {

/// Associations of the inliers. The pixel of a feature measures its position perpendicular to the ray. The
/// position along the ray is measured better by the depth around it. So each feature gives two associations
/// with normals perpendicular to the ray.
std::vector<Association> inliers(const std::vector<FeatureMatch>& matches);

/// Associations that hold a piece where it was predicted. Their total weight is a fixed share of the weight
/// of the piece's measurements, for any number of vertices.
/// @param piece predicted vertices. @param motion the piece's motion so far.
std::vector<Association> heldBack(const Points& piece, const Eigen::Isometry3d& motion,
                                  const AssociationRefs& measured);

/// Largest distance that the motions move a vertex of the prediction [m].
double largestMotion(const PredictedSurface& surface, const RigidMotions& motions);

/// The rigid motion of each piece that aligns the view with depth, contours and features (point-to-plane
/// ICP). Pieces that are almost hidden do not move.
RigidMotions alignRigidly(const RgbdFrame& frame, const View& view, const Labels& labels,
                          const std::vector<FeatureMatch>& matches, const MeasurementWeights& weights);

}  // namespace softbody
