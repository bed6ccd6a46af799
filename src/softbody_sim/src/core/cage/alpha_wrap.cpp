#include "cage/alpha_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <utility>
#include <vector>

#include "surface_mesh/cgal_mesh.h"

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
  return fromCgal(std::move(wrap));
}

}  // namespace softbody
