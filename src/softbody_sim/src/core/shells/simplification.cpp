#include "shells/simplification.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "surface_mesh/cgal_mesh.h"

namespace softbody {

TriangleMesh simplified(const TriangleMesh& mesh, int triangles) {
  namespace simplification = CGAL::Surface_mesh_simplification;
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  std::optional<CGAL::Surface_mesh<Point>> surface = toCgal<Point>(mesh);
  if (!surface)
    throw std::invalid_argument(
        "it cannot be simplified: more than two triangles meet at an edge; repair it");
  // A closed surface has three edges for two triangles.
  const simplification::Count_stop_predicate<CGAL::Surface_mesh<Point>> stop(
      static_cast<std::size_t>(3 * triangles / 2));
  simplification::edge_collapse(*surface, stop);
  return fromCgal(std::move(*surface));
}

}  // namespace softbody
