#include "softbody_scanning/surface/remeshing.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <random>
#include <stdexcept>
#include <vector>

namespace softbody::scanning {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Point = CGAL::Simple_cartesian<double>::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

Surface manifoldOf(const TriangleMesh& mesh) {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> polygons;
  for (const auto& p : mesh.vertices.rowwise()) points.emplace_back(p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles.rowwise())
    polygons.push_back(
        {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
  PMP::orient_polygon_soup(points, polygons);  // also duplicates the vertices at which it is no manifold
  Surface surface;
  PMP::polygon_soup_to_polygon_mesh(points, polygons, surface);
  return surface;
}

/// CGAL 5.5 crashes at a vertex whose triangles all lie on a line (its issue 7345). On a grid points do;
/// after a random shift they do not.
void takeOffLines(double shift_m, Surface* surface) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-shift_m, shift_m);
  for (const auto v : surface->vertices()) {
    const double x = shift(random), y = shift(random), z = shift(random);
    surface->point(v) = surface->point(v) + CGAL::Simple_cartesian<double>::Vector_3(x, y, z);
  }
}

TriangleMesh fromSurface(Surface surface) {
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

}  // namespace

TriangleMesh remeshed(const TriangleMesh& mesh, double edge_m) {
  constexpr unsigned kIterations = 3;
  constexpr double kShift =
      1e-4;  // of an edge: far above the precision of a triangle's normal, far below noise
  Surface surface = manifoldOf(mesh);
  if (surface.number_of_faces() == 0) throw std::invalid_argument("the surface has no triangles");
  takeOffLines(kShift * edge_m, &surface);
  PMP::isotropic_remeshing(surface.faces(), edge_m, surface,
                           PMP::parameters::number_of_iterations(kIterations));
  return fromSurface(std::move(surface));
}

}  // namespace softbody::scanning
