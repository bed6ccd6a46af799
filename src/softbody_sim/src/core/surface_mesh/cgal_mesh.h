#pragma once

#include <CGAL/Surface_mesh.h>

#include <optional>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A triangle mesh for CGAL's algorithms; nothing if more than two triangles meet at an edge, or two face
/// different ways.
template <typename Point>
std::optional<CGAL::Surface_mesh<Point>> toCgal(const TriangleMesh& mesh) {
  using Surface = CGAL::Surface_mesh<Point>;
  Surface surface;
  for (const auto& p : mesh.vertices.rowwise()) surface.add_vertex(Point(p[0], p[1], p[2]));
  const auto vertex = [](int index) {
    return typename Surface::Vertex_index(static_cast<typename Surface::size_type>(index));
  };
  for (const auto& t : mesh.triangles.rowwise()) {
    if (surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == Surface::null_face())
      return std::nullopt;
  }
  return surface;
}

template <typename Point>
TriangleMesh fromCgal(CGAL::Surface_mesh<Point> surface) {
  surface.collect_garbage();
  TriangleMesh mesh{Points(static_cast<Eigen::Index>(surface.number_of_vertices()), 3),
                    Triangles(static_cast<Eigen::Index>(surface.number_of_faces()), 3)};
  for (const auto v : surface.vertices()) {
    const Point& p = surface.point(v);
    mesh.vertices.row(static_cast<Eigen::Index>(v)) << p.x(), p.y(), p.z();
  }
  for (const auto f : surface.faces()) {
    int corner = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
      mesh.triangles(static_cast<Eigen::Index>(f), corner++) = static_cast<int>(v);
  }
  return mesh;
}

}  // namespace softbody
