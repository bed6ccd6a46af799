#include "cutting/split/half_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace softbody {

TriangleList listOf(const Triangles& triangles) {
  TriangleList list(static_cast<std::size_t>(triangles.rows()));
  for (std::size_t t = 0; t < list.size(); ++t) {
    for (int k = 0; k < 3; ++k) list[t][k] = triangles(static_cast<Eigen::Index>(t), k);
  }
  return list;
}

std::vector<int> halfEdgeMates(const TriangleList& triangles, int vertex_count) {
  struct Arrow {
    int end, half_edge;
  };
  const int count = 3 * static_cast<int>(triangles.size());
  // The half-edges sorted by their starts; those of vertex v begin at first[v].
  std::vector<int> first(static_cast<std::size_t>(vertex_count) + 1, 0),
      mates(static_cast<std::size_t>(count), -1);
  for (int h = 0; h < count; ++h) ++first[startOf(triangles, h)];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Arrow> arrows(static_cast<std::size_t>(count));
  for (int h = count - 1; h >= 0; --h) arrows[--first[startOf(triangles, h)]] = {endOf(triangles, h), h};
  for (int h = 0; h < count; ++h) {
    const int start = startOf(triangles, h), end = endOf(triangles, h);
    int found = 0;
    for (int k = first[end]; k < first[end + 1]; ++k) {
      if (arrows[k].end != start) continue;
      mates[h] = arrows[k].half_edge;
      ++found;
    }
    if (found != 1) {
      throw std::invalid_argument(fmt::format(
          "the mesh is not a closed oriented surface: the edge from vertex {} to {} has {} opposite "
          "triangles instead of one",
          start, end, found));
    }
  }
  return mates;
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
