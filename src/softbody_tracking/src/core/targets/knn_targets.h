#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "features/feature_map.h"
#include "prediction/association.h"
#include "prediction/predicted_surface.h"
#include "softbody_common/geometry/types.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// The paper's targets: each vertex of the low-resolution surface follows its nearest features with
/// inverse-distance weights (Kang et al. 2022, eq. 3-4). Displacements are measured from the reference frame.
/// A vertex without a feature within the radius gets no target. As in the paper, the matches' weights are not
/// used.
class KnnTargets {
 public:
  explicit KnnTargets(const KnnConfig& config) : config_(config) {}

  /// Computes the weights, once, in the reference frame. @param vertices #V by 3 of the volume then, fixed
  /// frame [m].
  void bind(const std::vector<MapFeature>& features, const TetTopology& volume, const Points& vertices);

  /// Targets from the features found in a frame. Features that were not found, or that a cut has separated
  /// from the vertex, are left out, and the remaining weights are normalised.
  /// @param R_camera_fixed rotation of the offsets for a body that has not turned since the reference frame.
  std::vector<Association> associations(const std::vector<MapFeature>& features,
                                        const std::vector<FeatureMatch>& matches,
                                        const PredictedSurface& surface,
                                        const Eigen::Matrix3d& R_camera_fixed) const;

  /// Transfers the vertices to an edited body.
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
    std::vector<Neighbor> neighbors;  ///< features within the radius, for the position
    std::vector<int> wider_ids;       ///< nearest features, for the local rotation
  };

  /// A feature's motion since the reference frame.
  struct FeatureMotion {
    std::uint32_t piece;
    Eigen::Vector3d reference, current;
  };
  using FeatureMotions = std::map<int, FeatureMotion>;  ///< by the feature's id

  Eigen::Matrix3d localRotation(const BoundVertex& vertex, const FeatureMotions& motions, std::uint32_t piece,
                                const Eigen::Matrix3d& fallback) const;
  static std::optional<Eigen::Vector3d> measuredPosition(const BoundVertex& vertex,
                                                         const FeatureMotions& motions, std::uint32_t piece,
                                                         const Eigen::Matrix3d& rotation);

  KnnConfig config_;
  std::vector<BoundVertex> vertices_;
};

/// Normalised inverse-distance weights of sorted distances: 1/D_j - 1/D_k (Kang et al. 2022, eq. 3). A
/// feature at distance 0 gets the whole weight. If all weights would be 0 (k = 1, or equal distances), they
/// are equal.
std::vector<double> inverseDistanceWeights(const std::vector<double>& sorted_distances);

}  // namespace softbody
