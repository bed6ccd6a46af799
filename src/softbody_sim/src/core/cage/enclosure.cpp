#include "cage/enclosure.h"

#include <algorithm>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"
#include "softbody_sim/surface_mesh/closest_point.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

constexpr double kTouching = 1e-9;  ///< distance over the size that counts as inside

}  // namespace

std::vector<OutsidePoint> pointsOutside(const Points& points, const TetMesh& mesh,
                                        const Triangles& boundary) {
  const TetLocator locator(mesh.vertices, mesh.tets);
  const ClosestPointQuery query(mesh.vertices, boundary);
  const double touching = kTouching * sizeOf(mesh.vertices);
  std::vector<OutsidePoint> outside;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const Eigen::Vector3d point = points.row(p);
    if (locator.contains(point)) continue;
    const SurfacePoint nearest = query.closest(point);
    const double distance = (nearest.position - point).norm();
    if (distance > touching) outside.push_back({p, nearest.triangle, nearest.position, distance});
  }
  return outside;
}

double largestDistance(const std::vector<OutsidePoint>& outside) {
  double largest = 0.0;
  for (const OutsidePoint& out : outside) largest = std::max(largest, out.distance);
  return largest;
}

}  // namespace softbody
