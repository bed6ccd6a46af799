#include "surface_mesh/half_edges.h"

#include <algorithm>

namespace softbody {

TriangleList listOf(const Triangles& triangles) {
  TriangleList list(static_cast<std::size_t>(triangles.rows()));
  for (std::size_t t = 0; t < list.size(); ++t) {
    for (int k = 0; k < 3; ++k) list[t][k] = triangles(static_cast<Eigen::Index>(t), k);
  }
  return list;
}

void pairHalfEdges(const TriangleList& triangles, const std::vector<int>& half_edges,
                   std::vector<int>* mates) {
  std::vector<std::array<int, 3>> edges;  // two ends in ascending order, half-edge
  edges.reserve(half_edges.size());
  for (const int h : half_edges) {
    const int start = startOf(triangles, h), end = endOf(triangles, h);
    edges.push_back({std::min(start, end), std::max(start, end), h});
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t k = 0; k + 1 < edges.size(); k += 2) {
    (*mates)[edges[k][2]] = edges[k + 1][2];
    (*mates)[edges[k + 1][2]] = edges[k][2];
  }
}

}  // namespace softbody
