#include "tet_mesher.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <vector>

namespace softbody {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using PlainDomain = CGAL::Polyhedral_mesh_domain_3<Surface, Kernel>;

/// A domain whose refinement starts from given points of its boundary. CGAL's own few random ones miss thin
/// parts.
class Domain : public PlainDomain {
 public:
  Domain(const Surface& surface, std::vector<Kernel::Point_3> seeds, CGAL::Random* random)
      : PlainDomain(surface, random), seeds_(std::move(seeds)) {}

  struct Construct_initial_points {
    const Domain& domain;
    template <typename Output>
    Output operator()(Output output, int /*count*/ = 0) const {
      for (const Kernel::Point_3& seed : domain.seeds_) {
        *output++ = std::make_pair(seed, domain.index_from_surface_patch_index({0, 1}));
      }
      return output;
    }
  };
  Construct_initial_points construct_initial_points_object() const { return {*this}; }

 private:
  std::vector<Kernel::Point_3> seeds_;
};

using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr double kSmallestAngle = 15.0;  ///< dihedral angle that sliver removal aims at [degrees]
constexpr double kSeedSpacing = 0.8;     ///< in edge lengths

Surface toSurface(const TriangleMesh& mesh) {
  Surface surface;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    surface.add_vertex({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)});
  }
  const auto vertex = [](int index) { return Surface::Vertex_index(static_cast<Surface::size_type>(index)); };
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const auto face = surface.add_face(vertex(mesh.triangles(f, 0)), vertex(mesh.triangles(f, 1)),
                                       vertex(mesh.triangles(f, 2)));
    if (face == Surface::null_face())
      throw std::runtime_error("the surface to be filled is not a 2-manifold");
  }
  return surface;
}

/// Vertices of a surface, and points of its triangles where those are larger than the distance, none nearer
/// to another than the distance.
std::vector<Kernel::Point_3> spreadPoints(const TriangleMesh& mesh, double distance) {
  std::vector<Kernel::Point_3> chosen;
  const auto add = [&chosen, distance](const Eigen::RowVector3d& p) {
    const Kernel::Point_3 point(p[0], p[1], p[2]);
    const auto near = [&](const Kernel::Point_3& other) {
      return CGAL::squared_distance(point, other) < distance * distance;
    };
    if (std::none_of(chosen.begin(), chosen.end(), near)) chosen.push_back(point);
  };
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) add(mesh.vertices.row(v));
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::RowVector3d a = mesh.vertices.row(mesh.triangles(f, 0));
    const Eigen::RowVector3d u = mesh.vertices.row(mesh.triangles(f, 1)) - a;
    const Eigen::RowVector3d v = mesh.vertices.row(mesh.triangles(f, 2)) - a;
    const int steps = static_cast<int>(std::max({u.norm(), v.norm(), (u - v).norm()}) / distance);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps && steps > 1; ++j) add(a + (i * u + j * v) / steps);
    }
  }
  return chosen;
}

TetMesh toTetMesh(const Complex& complex) {
  std::map<Triangulation::Vertex_handle, int> index;
  std::vector<Eigen::RowVector3d> vertices;
  std::vector<Eigen::RowVector4i> tets;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    Eigen::RowVector4i tet;
    for (int k = 0; k < 4; ++k) {
      const auto [entry, is_new] = index.emplace(cell->vertex(k), static_cast<int>(vertices.size()));
      const auto& point = cell->vertex(k)->point();
      if (is_new) vertices.emplace_back(point.x(), point.y(), point.z());
      tet[k] = entry->second;
    }
    tets.push_back(tet);
  }
  TetMesh mesh{Points(static_cast<Eigen::Index>(vertices.size()), 3),
               Tets(static_cast<Eigen::Index>(tets.size()), 4)};
  for (std::size_t v = 0; v < vertices.size(); ++v)
    mesh.vertices.row(static_cast<Eigen::Index>(v)) = vertices[v];
  for (std::size_t t = 0; t < tets.size(); ++t) mesh.tets.row(static_cast<Eigen::Index>(t)) = tets[t];
  return mesh;
}

}  // namespace

TetMesh meshInside(const TriangleMesh& surface, double edge_length_m) {
  namespace parameters = CGAL::parameters;
  const Surface boundary = toSurface(surface);
  // Seeded anew, so that earlier calls do not change the result.
  CGAL::get_default_random() = CGAL::Random(0);
  CGAL::Random random(0);
  const Domain domain(boundary, spreadPoints(surface, kSeedSpacing * edge_length_m), &random);
  // A regular triangle's circumradius is 0.58 edge lengths, a tet's 0.61; the refinement stops somewhere
  // below the bound.
  const Criteria criteria(parameters::facet_angle = 25.0, parameters::facet_size = 0.75 * edge_length_m,
                          parameters::facet_topology = CGAL::MANIFOLD,
                          parameters::cell_radius_edge_ratio = 2.5, parameters::cell_size = edge_length_m);
  // Left alone, sliver removal takes as long as the refinement took: another mesh every time. 0 means no
  // limit.
  const Complex complex = CGAL::make_mesh_3<Complex>(
      domain, criteria,
      parameters::perturb(parameters::time_limit = 0.0, parameters::sliver_bound = kSmallestAngle),
      parameters::exude(parameters::time_limit = 0.0, parameters::sliver_bound = kSmallestAngle));
  if (complex.number_of_cells_in_complex() == 0)
    throw std::runtime_error("the cage could not be filled with tets");
  return toTetMesh(complex);
}

}  // namespace softbody
