#pragma once

#include <vector>

#include "dynamics/edge_distances.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Confidence of each vertex's position: 1 if targets observe the vertex, otherwise exp(-d / (2 mean edge
/// lengths)) with the distance d to the nearest observed vertex along the tets' rest edges.
class VertexConfidence {
 public:
  VertexConfidence(const Points& rest_vertices, const Tets& tets);

  /// A vertex is observed if its barycentric coordinates, times the targets' weights, sum to at least 1/4.
  /// Targets of kind PRIOR do not count. Allocates nothing. @param confidence #V.
  void compute(const std::vector<Target>& targets, std::vector<float>* confidence);

 private:
  const Tets tets_;
  EdgeDistances edges_;
  std::vector<double> support_;   ///< per vertex: sum of the targets' weights
  std::vector<char> observed_;    ///< per vertex
  std::vector<double> distance_;  ///< per vertex, to the nearest observed one [m]
};

}  // namespace softbody
