#pragma once

#include <vector>

#include "features/feature_map.h"
#include "prediction/association.h"
#include "prediction/predicted_surface.h"
#include "softbody_common/types.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// The paper's targets: every low-resolution surface vertex follows its nearest features with
/// inverse-distance weights (Kang et al. 2022, eq. 3-4), displacements measured from the reference frame. A
/// vertex without any feature within the radius gets no target. What a match weighs does not count, as in the
/// paper.
class KnnTargets {
 public:
  explicit KnnTargets(const KnnConfig& config) : config_(config) {}

  /// Weights, once, in the reference frame. @param vertices volume vertices there, fixed frame.
  void bind(const std::vector<MapFeature>& features, const TetTopology& volume, const Points& vertices);

  /// Where the vertices' features have gone. Neighbours that were not found, or that a cut has parted from
  /// the vertex, leave their weight to the others. @param R_camera_fixed turns offsets of then into those of
  /// a body that has not turned since.
  std::vector<Association> associations(const std::vector<MapFeature>& features,
                                        const std::vector<FeatureMatch>& matches,
                                        const PredictedSurface& surface,
                                        const Eigen::Matrix3d& R_camera_fixed) const;

  /// Takes the vertices to an edited body.
  void rebind(const TetTopology& before, const TetTopology& after);

  void reset() { vertices_.clear(); }

 private:
  struct Neighbor {
    int feature_id;
    double weight;
  };
  struct BoundVertex {
    MaterialPoint place;
    Eigen::Vector3d reference;
    std::vector<Neighbor> neighbors;  ///< within the radius, for the position
    std::vector<int> wider_ids;       ///< for the local rotation
  };

  KnnConfig config_;
  std::vector<BoundVertex> vertices_;
};

/// Normalised inverse-distance weights of sorted distances (eq. 3): 1/D_j - 1/D_k. The guards: a feature at
/// distance 0 takes all, and where every weight would be 0 (k = 1, or all distances equal) they are equal.
std::vector<double> inverseDistanceWeights(const std::vector<double>& sorted_distances);

}  // namespace softbody
