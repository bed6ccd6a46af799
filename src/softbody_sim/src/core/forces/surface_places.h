#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Places of the surface on which forces may act: all its vertices, or the vertices around evenly spread ones
/// if there are more than `max_count`.
struct SurfacePlaces {
  SurfacePlaces(const TetTopology& topology, std::size_t max_count);

  std::size_t count() const { return vertices.size(); }

  Triangles triangles;                        ///< of the surface
  std::vector<std::vector<int>> vertices;     ///< of each place
  std::vector<int> of_vertex;                 ///< #V, -1 inside the body
  std::vector<double> shares;                 ///< #V, of the force on the vertex's place; by area
  std::vector<std::pair<int, int>> touching;  ///< places that share an edge of the surface
};

}  // namespace softbody
