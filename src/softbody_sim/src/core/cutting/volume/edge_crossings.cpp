#include "cutting/volume/edge_crossings.h"

#include <algorithm>
#include <tuple>

#include "cutting/patch/patch_slab.h"

namespace softbody {
namespace {

/// The edges that meet the slab and have no end on the cut, each once.
std::vector<EdgeCrossing> candidates(const Tets& tets, const std::vector<bool>& on_cut,
                                     const std::vector<signed char>& sides) {
  std::vector<EdgeCrossing> edges;
  for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        const auto [a, b] = std::minmax(tets(t, i), tets(t, j));
        const auto u = static_cast<std::size_t>(a), v = static_cast<std::size_t>(b);
        const bool on_one_side = sides[u] != 0 && sides[u] == sides[v];
        if (!on_one_side && !on_cut[u] && !on_cut[v]) edges.push_back({a, b, t, 0.0});
      }
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeCrossing& x, const EdgeCrossing& y) {
    return std::tie(x.a, x.b, x.tet) < std::tie(y.a, y.b, y.tet);
  });
  const auto same = [](const EdgeCrossing& x, const EdgeCrossing& y) { return x.a == y.a && x.b == y.b; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

}  // namespace

std::vector<EdgeCrossing> edgeCrossings(const Points& vertices, const Tets& tets,
                                        const std::vector<bool>& on_cut, const PatchIntersector& patch) {
  std::vector<EdgeCrossing> edges = candidates(tets, on_cut, PatchSlab(patch.mesh()).sidesOf(vertices));
  const auto misses = [&](EdgeCrossing& edge) {
    const std::vector<PatchHit> hits = patch.hits(vertices.row(edge.a), vertices.row(edge.b));
    if (hits.size() % 2 == 0) return true;
    edge.t = hits[hits.size() / 2].t;
    return false;
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), misses), edges.end());
  const auto squaredLength = [&vertices](const EdgeCrossing& e) {
    return (vertices.row(e.a) - vertices.row(e.b)).squaredNorm();
  };
  std::stable_sort(edges.begin(), edges.end(), [&](const EdgeCrossing& x, const EdgeCrossing& y) {
    return squaredLength(x) > squaredLength(y);
  });
  return edges;
}

}  // namespace softbody
