#include "softbody_sim/surface_mesh/cut_lines.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace softbody {
namespace {

/// Calls `use` with the edges, lower index first, of the triangles with or without the cut flag.
template <typename Use>
void forEachEdge(const MeshTopology& mesh, bool of_cuts, Use use) {
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (mesh.cut[static_cast<std::size_t>(t)] != of_cuts) continue;
    for (int k = 0; k < 3; ++k)
      use(std::pair<int, int>(std::minmax<int>({mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)})));
  }
}

}  // namespace

Edges cutLines(const MeshTopology& mesh) {
  std::set<std::pair<int, int>> of_cuts, lines;
  std::vector<bool> on_cut(static_cast<std::size_t>(mesh.rest_vertices.rows()), false);
  forEachEdge(mesh, true, [&](const std::pair<int, int>& edge) {
    of_cuts.insert(edge);
    on_cut[static_cast<std::size_t>(edge.first)] = true;
  });
  // The flag per vertex spares most edges of a fine surface the lookup.
  forEachEdge(mesh, false, [&](const std::pair<int, int>& edge) {
    if (on_cut[static_cast<std::size_t>(edge.first)] && of_cuts.count(edge) != 0) lines.insert(edge);
  });
  Edges result(static_cast<Eigen::Index>(lines.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [a, b] : lines) result.row(row++) << a, b;
  return result;
}

}  // namespace softbody
