#include "constraints/static_support.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

void requireHeld(const TetTopology& topology, const std::vector<Target>& targets,
                 const Surroundings& surroundings, const Points& loads) {
  if (!surroundings.obstacles.empty()) return;  // one may hold it
  std::vector<bool> held(static_cast<std::size_t>(topology.rest_vertices.rows()), false);
  for (const Pin& pin : surroundings.pins) held[static_cast<std::size_t>(pin.vertex)] = true;
  for (const Target& target : targets)
    held[static_cast<std::size_t>(topology.tets(target.place.tet, 0))] = true;
  const auto pieces = verticesOfPieces(topology.tets, topology.rest_vertices.rows());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    bool is_held = false, loaded = false;
    for (const int v : pieces[p]) {
      is_held = is_held || held[static_cast<std::size_t>(v)];
      loaded = loaded || !loads.row(v).isZero(0.0);
    }
    if (loaded && !is_held) {
      throw std::invalid_argument(fmt::format(
          "piece {} of {} (with vertex {}) is held by nothing, but loads act on it; pin some of its "
          "vertices or add an obstacle",
          p + 1, pieces.size(), pieces[p].front()));
    }
  }
}

}  // namespace softbody
