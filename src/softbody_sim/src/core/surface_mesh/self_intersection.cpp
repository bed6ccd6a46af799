#include "surface_mesh/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <utility>
#include <vector>

#include "surface_mesh/cgal_mesh.h"

namespace softbody {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

}  // namespace

bool intersectsItself(const TriangleMesh& mesh) {
  const std::optional<Surface> surface = toCgal<Point>(mesh);
  return !surface || CGAL::Polygon_mesh_processing::does_self_intersect(*surface);
}

std::vector<std::array<Eigen::Index, 2>> crossingTriangles(const TriangleMesh& mesh) {
  const std::optional<Surface> surface = toCgal<Point>(mesh);
  if (!surface) return {};
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(*surface, std::back_inserter(pairs));
  std::vector<std::array<Eigen::Index, 2>> triangles;
  for (const auto& [a, b] : pairs)
    triangles.push_back({static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)});
  return triangles;
}

}  // namespace softbody
