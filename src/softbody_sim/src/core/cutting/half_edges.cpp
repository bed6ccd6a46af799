#include "core/cutting/half_edges.h"

#include <fmt/format.h>

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
  const int count = 3 * static_cast<int>(triangles.size());
  // The half-edges that start at a vertex, as a linked list per vertex.
  std::vector<int> first(static_cast<std::size_t>(vertex_count), -1), following(count, -1), mates(count, -1);
  for (int h = 0; h < count; ++h) {
    const int start = startOf(triangles, h);
    following[h] = first[start];
    first[start] = h;
  }
  for (int h = 0; h < count; ++h) {
    const int start = startOf(triangles, h);
    int found = 0;
    for (int g = first[endOf(triangles, h)]; g >= 0; g = following[g]) {
      if (endOf(triangles, g) != start) continue;
      mates[h] = g;
      ++found;
    }
    if (found != 1) {
      throw std::invalid_argument(fmt::format(
          "the mesh is not a closed oriented surface: the edge from vertex {} to {} has {} opposite "
          "triangles instead of one",
          start, endOf(triangles, h), found));
    }
  }
  return mates;
}

}  // namespace softbody
