#include "cage/progressive_hull.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "cage/half_spaces.h"
#include "surface_mesh/cgal_mesh.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr double kTriangleMargin = 1e-6;      ///< distance from the replaced triangles, over the size
constexpr double kMinCollapseCosine = 0.2;    ///< cosine of the angle by which a collapse may turn a triangle
constexpr double kMinCollapsedHeight = 0.15;  ///< height of a triangle over its longest edge

Eigen::Vector3d toVector(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

struct Placement {
  double size;

  template <typename Profile>
  std::optional<Eigen::Vector3d> place(const Profile& profile) const {
    std::vector<HalfSpace> outside;
    const Surface& mesh = profile.surface_mesh();
    for (const auto& t : profile.triangles()) {
      const Eigen::Vector3d a = toVector(mesh.point(t.v0)), b = toVector(mesh.point(t.v1)),
                            c = toVector(mesh.point(t.v2));
      const Eigen::Vector3d normal = (b - a).cross(c - a);
      if (normal.norm() < 1e-20) continue;
      outside.push_back({normal.normalized(), normal.normalized().dot(a) + kTriangleMargin * size});
    }
    const Eigen::Vector3d middle = 0.5 * (toVector(profile.p0()) + toVector(profile.p1()));
    return nearestPointIn(outside, middle, 0.1 * kTriangleMargin * size);
  }

  template <typename Profile>
  bool keepsShape(const Profile& profile, const Eigen::Vector3d& x) const {
    const Surface& mesh = profile.surface_mesh();
    for (const auto& t : profile.triangles()) {
      const std::array<Surface::Vertex_index, 3> corners{t.v0, t.v1, t.v2};
      const auto moves = [&profile](Surface::Vertex_index v) {
        return v == profile.v0() || v == profile.v1();
      };
      if (std::count_if(corners.begin(), corners.end(), moves) != 1) continue;
      std::array<Eigen::Vector3d, 3> before, after;
      for (int k = 0; k < 3; ++k) {
        before[k] = toVector(mesh.point(corners[k]));
        after[k] = moves(corners[k]) ? x : before[k];
      }
      const auto normalOf = [](const std::array<Eigen::Vector3d, 3>& p) -> Eigen::Vector3d {
        return (p[1] - p[0]).cross(p[2] - p[0]);
      };
      const auto shapeOf = [&normalOf](const std::array<Eigen::Vector3d, 3>& p) {
        return normalOf(p).norm() / std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(),
                                              (p[0] - p[2]).squaredNorm()});
      };
      const Eigen::Vector3d n0 = normalOf(before).normalized(), n1 = normalOf(after).normalized();
      if (n0.dot(n1) < kMinCollapseCosine) return false;
      if (shapeOf(after) < std::min(kMinCollapsedHeight, shapeOf(before))) return false;
    }
    return true;
  }

  /// Boost's optional up to CGAL 5, that of the standard library from CGAL 6 on.
  template <typename Profile>
  auto operator()(const Profile& profile) const {
    decltype(simplification::Midpoint_placement<Surface>()(profile)) placed;
    const std::optional<Eigen::Vector3d> x = place(profile);
    if (x && keepsShape(profile, *x)) placed = Kernel::Point_3(x->x(), x->y(), x->z());
    return placed;
  }
};

}  // namespace

TriangleMesh progressiveHull(const TriangleMesh& mesh, int vertices) {
  std::optional<Surface> built = toCgal<Kernel::Point_3>(mesh);
  if (!built) throw std::runtime_error("the wrap is not a closed surface");
  Surface& surface = *built;
  const long excess =
      static_cast<long>(surface.number_of_edges()) - 3L * static_cast<long>(surface.number_of_vertices());
  const auto edges = static_cast<std::size_t>(std::max(6L, 3L * vertices + excess));
  simplification::edge_collapse(surface, simplification::Count_stop_predicate<Surface>(edges),
                                CGAL::parameters::get_cost(simplification::Edge_length_cost<Surface>())
                                    .get_placement(Placement{sizeOf(mesh.vertices)}));
  return fromCgal(std::move(surface));
}

}  // namespace softbody
