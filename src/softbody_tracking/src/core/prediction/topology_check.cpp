#include "prediction/topology_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace softbody {
namespace {

/// @param what names the elements at the start of the message.
template <typename Elements>
void requireVertices(const Elements& elements, Eigen::Index count, const char* what) {
  if (elements.rows() == 0) return;
  for (const int vertex : {elements.minCoeff(), elements.maxCoeff()}) {
    if (vertex < 0 || vertex >= count)
      throw std::invalid_argument(fmt::format("{} names vertex {} of {}", what, vertex, count));
  }
}

/// A list may be empty.
void requireOneForEach(const Triangles& triangles, std::size_t count, const char* what) {
  if (count != 0 && count != static_cast<std::size_t>(triangles.rows())) {
    throw std::invalid_argument(
        fmt::format("the surface's topology has {} {} for {} triangles", count, what, triangles.rows()));
  }
}

/// Row of a vertex with each parent; -1 is no parent.
std::unordered_map<int, Eigen::Index> rowsByParent(const std::vector<int>& parents, Eigen::Index vertices) {
  std::unordered_map<int, Eigen::Index> rows;
  const Eigen::Index count = std::min(vertices, static_cast<Eigen::Index>(parents.size()));
  for (Eigen::Index row = 0; row < count; ++row) {
    const int parent = parents[static_cast<std::size_t>(row)];
    if (parent >= 0) rows.emplace(parent, row);
  }
  return rows;
}

template <typename Topology>
bool mostStay(const Topology& before, const Topology& after) {
  const auto rows = rowsByParent(before.vertex_parents, before.rest_vertices.rows());
  std::size_t shared = 0, same = 0;
  for (const auto& [parent, row] : rowsByParent(after.vertex_parents, after.rest_vertices.rows())) {
    const auto known = rows.find(parent);
    if (known == rows.end()) continue;
    ++shared;
    if (before.rest_vertices.row(known->second).template cast<float>() ==
        after.rest_vertices.row(row).template cast<float>())
      ++same;
  }
  return 2 * same >= shared;
}

}  // namespace

bool mayBeEditOf(const TetTopology& before, const TetTopology& after) { return mostStay(before, after); }
bool mayBeEditOf(const MeshTopology& before, const MeshTopology& after) { return mostStay(before, after); }

void requireWhole(const TetTopology& volume, const MeshTopology& surface) {
  if (volume.tets.rows() == 0) throw std::invalid_argument("the volume's topology has no tet");
  requireVertices(volume.tets, volume.rest_vertices.rows(), "a tet of the volume's topology");
  requireVertices(volume.surface, volume.rest_vertices.rows(), "a triangle of the volume's topology");
  requireVertices(surface.triangles, surface.rest_vertices.rows(), "a triangle of the surface's topology");
  requireOneForEach(surface.triangles, surface.triangle_pieces.size(), "piece numbers");
  requireOneForEach(surface.triangles, surface.cut.size(), "marks of cuts");
}

}  // namespace softbody
