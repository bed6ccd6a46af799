#include "surface_mesh/orientation.h"

#include <algorithm>
#include <map>
#include <utility>

namespace softbody {
namespace {

struct EdgeUse {
  int triangle;
  bool ascending;  ///< the triangle runs from the lower to the higher vertex
};
using Edges = std::map<std::pair<int, int>, std::vector<EdgeUse>>;

Edges edgesOf(const Triangles& triangles) {
  Edges edges;
  for (int f = 0; f < static_cast<int>(triangles.rows()); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      edges[std::minmax(a, b)].push_back({f, a < b});
    }
  }
  return edges;
}

/// Per triangle its neighbours, and whether their orientations disagree: both run through the common edge in
/// the same direction.
std::vector<std::vector<std::pair<int, bool>>> neighbours(const Triangles& triangles) {
  std::vector<std::vector<std::pair<int, bool>>> result(static_cast<std::size_t>(triangles.rows()));
  for (const auto& [edge, uses] : edgesOf(triangles)) {
    if (uses.size() != 2) continue;
    const bool disagree = uses[0].ascending == uses[1].ascending;
    result[static_cast<std::size_t>(uses[0].triangle)].emplace_back(uses[1].triangle, disagree);
    result[static_cast<std::size_t>(uses[1].triangle)].emplace_back(uses[0].triangle, disagree);
  }
  return result;
}

}  // namespace

std::vector<bool> trianglesToFlip(const Triangles& triangles) {
  const auto adjacent = neighbours(triangles);
  std::vector<bool> turn(adjacent.size(), false), reached(adjacent.size(), false);
  for (std::size_t seed = 0; seed < adjacent.size(); ++seed) {
    if (reached[seed]) continue;
    std::vector<std::size_t> patch{seed};
    reached[seed] = true;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      for (const auto& [neighbour, disagree] : adjacent[patch[next]]) {
        const auto n = static_cast<std::size_t>(neighbour);
        if (reached[n]) continue;
        reached[n] = true;
        turn[n] = turn[patch[next]] != disagree;
        patch.push_back(n);
      }
    }
    const auto turned = std::count_if(patch.begin(), patch.end(), [&turn](std::size_t f) { return turn[f]; });
    if (2 * turned > static_cast<std::ptrdiff_t>(patch.size())) {
      for (const std::size_t f : patch) turn[f] = !turn[f];
    }
  }
  return turn;
}

}  // namespace softbody
