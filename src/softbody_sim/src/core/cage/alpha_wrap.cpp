#include "cage/alpha_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

namespace softbody {

TriangleMesh alphaWrap(const TriangleMesh& mesh, double alpha_m, double offset_m) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  std::vector<Point> points;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    points.emplace_back(mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
  }
  std::vector<std::array<std::size_t, 3>> faces;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    faces.push_back({static_cast<std::size_t>(mesh.triangles(f, 0)),
                     static_cast<std::size_t>(mesh.triangles(f, 1)),
                     static_cast<std::size_t>(mesh.triangles(f, 2))});
  }
  CGAL::Surface_mesh<Point> wrap;
  CGAL::alpha_wrap_3(points, faces, alpha_m, offset_m, wrap);
  wrap.collect_garbage();

  TriangleMesh result;
  result.vertices.resize(static_cast<Eigen::Index>(wrap.number_of_vertices()), 3);
  for (const auto vertex : wrap.vertices()) {
    const Point& point = wrap.point(vertex);
    result.vertices.row(static_cast<Eigen::Index>(vertex)) << point.x(), point.y(), point.z();
  }
  result.triangles.resize(static_cast<Eigen::Index>(wrap.number_of_faces()), 3);
  for (const auto face : wrap.faces()) {
    int corner = 0;
    for (const auto vertex : wrap.vertices_around_face(wrap.halfedge(face))) {
      result.triangles(static_cast<Eigen::Index>(face), corner++) = static_cast<int>(vertex);
    }
  }
  return result;
}

}  // namespace softbody
