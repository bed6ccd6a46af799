#pragma once

#include <vector>

#include "depth/depth_associations.h"
#include "features/feature_map.h"
#include "prediction/predicted_surface.h"

namespace softbody {

/// Below so many features and depth points nothing is fixed.
constexpr int kFewestAssociations = 12;

/// The matches that are no outliers. A feature's image position says where it is across its ray; how far
/// along it, the depth around says better: two associations each, with normals across the ray.
std::vector<Association> inliers(const std::vector<FeatureMatch>& matches);

/// What draws a piece back to where it was predicted, by a share of what its measurements weigh, however many
/// vertices it has. @param piece its vertices as predicted. @param motion that they were moved by since.
std::vector<Association> heldBack(const Points& piece, const Eigen::Isometry3d& motion,
                                  const AssociationRefs& measured);

/// How far the motions take any vertex of the prediction [m].
double largestMotion(const PredictedSurface& surface, const RigidMotions& motions);

/// Brings a prediction and what is observed together, piece by piece of the body (ICP, point to plane).
class RigidAlignment {
 public:
  /// The rigid motions that the depth and the features ask of the prediction. A piece that hardly shows
  /// stays.
  /// @param depth associates with the samples of the surface as rendered.
  RigidMotions align(const RgbdFrame& frame, const PredictedSurface& surface, const SurfaceSamples& samples,
                     const ColorModel& colors, const std::vector<FeatureMatch>& matches,
                     DepthAssociator* depth);

 private:
  void gather(const DepthAssociations& depth, const RigidMotions& motions);

  std::vector<Association> features_, moved_;  ///< as predicted, and as moved so far
  std::vector<AssociationRefs> of_body_;       ///< all that is seen of a piece
};

}  // namespace softbody
