#pragma once

#include <utility>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Distances along the rest edges of the tets.
class EdgeDistances {
 public:
  EdgeDistances(const Points& rest_vertices, const Tets& tets);

  double meanLength() const { return mean_length_; }  ///< of the edges [m]

  /// Distance of each vertex from the nearest source [m]; infinite if no path leads there (Dijkstra's
  /// algorithm). Allocates nothing once the result has its size. @param sources of each vertex: not 0 for a
  /// source.
  void fromNearest(const std::vector<char>& sources, std::vector<double>* distances);

 private:
  struct Neighbor {
    int vertex;
    double distance;  ///< [m]
  };
  std::vector<std::vector<Neighbor>> neighbors_;
  double mean_length_ = 0.0;
  std::vector<std::pair<double, int>> queue_;
};

}  // namespace softbody
