#pragma once

#include <utility>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// How far each vertex's position rests on this frame's measurements: 1 where targets act on the vertex
/// itself, and exp(-d / (2 mean edge lengths)) at the distance d along the tets' rest edges from the nearest
/// such vertex.
class VertexConfidence {
 public:
  VertexConfidence(const Points& rest_vertices, const Tets& tets);

  /// A vertex is observed when its barycentric shares, times the targets' weights, sum to at least 1/4.
  /// Allocates nothing. @param confidence #V.
  void compute(const std::vector<Target>& targets, std::vector<float>* confidence);

 private:
  struct Neighbor {
    int vertex;
    double distance;  ///< [m]
  };
  /// From where support_ is enough.
  void findDistances();

  const Tets tets_;
  std::vector<std::vector<Neighbor>> neighbors_;
  double decay_length_ = 0.0;               ///< [m]
  std::vector<double> support_, distance_;  ///< per vertex
  std::vector<std::pair<double, int>> queue_;
};

}  // namespace softbody
