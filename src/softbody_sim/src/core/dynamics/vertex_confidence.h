#pragma once

#include <utility>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Confidence of each vertex's position: 1 if targets observe the vertex, otherwise exp(-d / (2 mean edge
/// lengths)) with the distance d to the nearest observed vertex along the tets' rest edges.
class VertexConfidence {
 public:
  VertexConfidence(const Points& rest_vertices, const Tets& tets);

  /// A vertex is observed if its barycentric coordinates, times the targets' weights, sum to at least 1/4.
  /// Allocates nothing. @param confidence #V.
  void compute(const std::vector<Target>& targets, std::vector<float>* confidence);

 private:
  struct Neighbor {
    int vertex;
    double distance;  ///< [m]
  };
  /// From the vertices with enough support.
  void findDistances();

  const Tets tets_;
  std::vector<std::vector<Neighbor>> neighbors_;
  double decay_length_ = 0.0;               ///< [m]
  std::vector<double> support_, distance_;  ///< per vertex
  std::vector<std::pair<double, int>> queue_;
};

}  // namespace softbody
