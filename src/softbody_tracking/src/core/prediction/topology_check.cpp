#include "prediction/topology_check.h"

#include <fmt/format.h>

#include <stdexcept>

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

}  // namespace

void requireWhole(const TetTopology& volume, const MeshTopology& surface) {
  if (volume.tets.rows() == 0) throw std::invalid_argument("the volume's topology has no tet");
  requireVertices(volume.tets, volume.rest_vertices.rows(), "a tet of the volume's topology");
  requireVertices(volume.surface, volume.rest_vertices.rows(), "a triangle of the volume's topology");
  requireVertices(surface.triangles, surface.rest_vertices.rows(), "a triangle of the surface's topology");
  requireOneForEach(surface.triangles, surface.triangle_pieces.size(), "piece numbers");
  requireOneForEach(surface.triangles, surface.cut.size(), "marks of cuts");
}

}  // namespace softbody
