#include "forces/surface_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// A third of each triangle's area to each of its vertices; 0 inside the body [m^2].
std::vector<double> vertexAreas(const Points& vertices, const Triangles& triangles) {
  std::vector<double> areas(static_cast<std::size_t>(vertices.rows()), 0.0);
  for (const auto& triangle : triangles.rowwise()) {
    const Eigen::Vector3d a = vertices.row(triangle[0]), b = vertices.row(triangle[1]),
                          c = vertices.row(triangle[2]);
    for (int k = 0; k < 3; ++k)
      areas[static_cast<std::size_t>(triangle[k])] += (b - a).cross(c - a).norm() / 6.0;
  }
  return areas;
}

/// Farthest-point sampling; gives each vertex of the surface its nearest sample.
void spread(const Points& vertices, const std::vector<int>& surface, std::size_t count,
            std::vector<int>* place_of_vertex) {
  std::vector<double> distances(surface.size(), std::numeric_limits<double>::infinity());
  std::size_t sample = 0;
  for (std::size_t place = 0; place < count; ++place) {
    for (std::size_t k = 0; k < surface.size(); ++k) {
      const double distance = (vertices.row(surface[k]) - vertices.row(surface[sample])).norm();
      if (distance >= distances[k]) continue;
      distances[k] = distance;
      (*place_of_vertex)[static_cast<std::size_t>(surface[k])] = static_cast<int>(place);
    }
    sample =
        static_cast<std::size_t>(std::max_element(distances.begin(), distances.end()) - distances.begin());
  }
}

}  // namespace

SurfacePlaces::SurfacePlaces(const TetTopology& topology, std::size_t max_count)
    : triangles(boundaryTriangles(topology.tets)),
      of_vertex(static_cast<std::size_t>(topology.rest_vertices.rows()), -1),
      shares(vertexAreas(topology.rest_vertices, triangles)) {
  std::vector<int> surface;
  for (std::size_t v = 0; v < shares.size(); ++v) {
    if (shares[v] > 0.0) surface.push_back(static_cast<int>(v));
  }
  spread(topology.rest_vertices, surface, std::min(max_count, surface.size()), &of_vertex);
  std::vector<double> areas(std::min(max_count, surface.size()), 0.0);
  vertices.resize(areas.size());
  for (int v : surface) {
    const auto place = static_cast<std::size_t>(of_vertex[static_cast<std::size_t>(v)]);
    areas[place] += shares[static_cast<std::size_t>(v)];
    vertices[place].push_back(v);
  }
  for (int v : surface)
    shares[static_cast<std::size_t>(v)] /=
        areas[static_cast<std::size_t>(of_vertex[static_cast<std::size_t>(v)])];
  std::set<std::pair<int, int>> pairs;
  for (const auto& triangle : triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const int a = of_vertex[static_cast<std::size_t>(triangle[k])],
                b = of_vertex[static_cast<std::size_t>(triangle[(k + 1) % 3])];
      if (a != b) pairs.emplace(std::min(a, b), std::max(a, b));
    }
  }
  touching.assign(pairs.begin(), pairs.end());
}

}  // namespace softbody
