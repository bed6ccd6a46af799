#include "surface_mesh/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace softbody {

bool intersectsItself(const TriangleMesh& mesh) {
  using Surface = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
  Surface surface;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    surface.add_vertex({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)});
  }
  const auto vertex = [](int index) { return Surface::Vertex_index(static_cast<Surface::size_type>(index)); };
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const auto face = surface.add_face(vertex(mesh.triangles(f, 0)), vertex(mesh.triangles(f, 1)),
                                       vertex(mesh.triangles(f, 2)));
    if (face == Surface::null_face()) return true;  // more than two triangles meet
  }
  return CGAL::Polygon_mesh_processing::does_self_intersect(surface);
}

}  // namespace softbody
