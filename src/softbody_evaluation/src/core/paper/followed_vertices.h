#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/tracker/tracking_result.h"

namespace softbody::evaluation {

/// Where its features take a vertex of the volume [m].
struct MovedVertex {
  int vertex;
  Eigen::Vector3d position;
};

/// Normalised inverse-distance weights of sorted distances: 1/D_j - 1/D_k (Kang et al. 2022, eq. 3). A
/// feature at distance 0 gets the whole weight. If all weights would be 0 (k = 1, or equal distances), they
/// are equal.
std::vector<double> inverseDistanceWeights(const std::vector<double>& sorted_distances);

/// Vertices of the low-resolution surface that follow their nearest features (Kang et al. 2022, eq. 3-4),
/// without rotation: so they are wrong where the body turns. A vertex without a feature within delta_k
/// follows none.
class FollowedVertices {
 public:
  /// @param features with their references. @param vertices #V by 3 of the volume, where the features have
  /// their references [m].
  FollowedVertices(const std::vector<TrackedFeature>& features, const TetTopology& volume,
                   const Points& vertices);

  /// The vertices of which any feature was found.
  std::vector<MovedVertex> moved(const std::vector<TrackedFeature>& found) const;

 private:
  struct Neighbor {
    int feature_id;
    double weight;
  };
  struct Vertex {
    int index;
    Eigen::Vector3d reference;
    std::vector<Neighbor> neighbors;
  };

  std::vector<Vertex> vertices_;
};

}  // namespace softbody::evaluation
