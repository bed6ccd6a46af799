#include "texture/edge_neighbors.h"

#include <algorithm>

namespace softbody::scanning {

EdgeNeighbors edgeNeighbors(const Triangles& triangles) {
  struct Side {
    int low, high, triangle, corner;
  };
  std::vector<Side> sides;
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({triangles(t, k), triangles(t, (k + 1) % 3)});
      sides.push_back({low, high, t, k});
    }
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  EdgeNeighbors neighbors(static_cast<std::size_t>(triangles.rows()), {-1, -1, -1});
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &a = sides[i - 1], &b = sides[i];
    int& beyond = neighbors[static_cast<std::size_t>(a.triangle)][static_cast<std::size_t>(a.corner)];
    if (a.low != b.low || a.high != b.high || beyond >= 0) continue;
    beyond = b.triangle;
    neighbors[static_cast<std::size_t>(b.triangle)][static_cast<std::size_t>(b.corner)] = a.triangle;
  }
  return neighbors;
}

}  // namespace softbody::scanning
