#include "cutting/volume/version_edits.h"

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

std::vector<int> parentsOf(const TetEdit& edit) {
  std::vector<int> parents(static_cast<std::size_t>(edit.topology.tets.rows()), -1);
  for (std::size_t t = 0; t < edit.successors.size(); ++t) {
    for (const int part : edit.successors[t]) parents[static_cast<std::size_t>(part)] = static_cast<int>(t);
  }
  return parents;
}

TetEdit editForward(const TetTopology& earlier, const TetTopology& later, const std::vector<bool>& cut,
                    const std::vector<int>& parents) {
  TetEdit edit{later, cut, placesOfVertices(earlier), {}};
  const auto kept = static_cast<Eigen::Index>(edit.vertex_origins.size());
  std::vector<MaterialPoint> places = placesOfVertices(later);
  for (Eigen::Index v = kept; v < later.rest_vertices.rows(); ++v) {
    MaterialPoint& place = places[static_cast<std::size_t>(v)];
    place.tet = parents[static_cast<std::size_t>(place.tet)];
    place.barycentric = barycentricCoordinates(later.rest_vertices.row(v).transpose(), earlier.rest_vertices,
                                               earlier.tets.row(place.tet));
    edit.vertex_origins.push_back(place);
  }
  edit.successors.resize(static_cast<std::size_t>(earlier.tets.rows()));
  for (std::size_t t = 0; t < parents.size(); ++t)
    edit.successors[static_cast<std::size_t>(parents[t])].push_back(static_cast<int>(t));
  return edit;
}

TetEdit editBack(const TetTopology& later, const TetTopology& earlier, const std::vector<bool>& cut,
                 const std::vector<int>& parents) {
  TetEdit edit{earlier, cut, placesOfVertices(later), {}};
  edit.vertex_origins.resize(static_cast<std::size_t>(earlier.rest_vertices.rows()));
  for (const int parent : parents) edit.successors.push_back({parent});
  return edit;
}

}  // namespace softbody
