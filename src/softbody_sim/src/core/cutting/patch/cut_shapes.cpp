#include "softbody_sim/cutting/patch/cut_shapes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace softbody {

TriangleMesh planePatch(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Points& body) {
  if (!point.allFinite() || !normal.allFinite() || normal.isZero(0.0))
    throw std::invalid_argument("a plane needs a finite point and a normal that is not zero");
  const Eigen::Vector3d low = body.colwise().minCoeff(), high = body.colwise().maxCoeff();
  const Eigen::Vector3d n = normal.normalized(), middle = 0.5 * (low + high);
  const Eigen::Vector3d center = middle - n.dot(middle - point) * n;
  const Eigen::Vector3d u = (high - low).norm() * n.unitOrthogonal(), v = n.cross(u);
  TriangleMesh patch{Points(4, 3), Triangles(2, 3)};
  patch.vertices << (center - u - v).transpose(), (center + u - v).transpose(), (center + u + v).transpose(),
      (center - u + v).transpose();
  patch.triangles << 0, 1, 2, 0, 2, 3;
  return patch;
}

TriangleMesh polygonPatch(const Points& corners) {
  const Eigen::Index count = corners.rows();
  if (count < 3) throw std::invalid_argument(fmt::format("a polygon needs 3 corners or more, not {}", count));
  if (!corners.allFinite()) throw std::invalid_argument("a corner of the polygon is not finite");
  const Eigen::Vector3d origin = corners.row(0);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 1; i + 1 < count; ++i) {
    const Eigen::Vector3d a = corners.row(i).transpose() - origin,
                          b = corners.row(i + 1).transpose() - origin;
    normal += a.cross(b);
  }
  const double size = (corners.rowwise() - corners.row(0)).rowwise().norm().maxCoeff();
  normal.normalize();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d here = corners.row(i), next = corners.row((i + 1) % count),
                          after = corners.row((i + 2) % count);
    if (std::abs(normal.dot(here - origin)) > 1e-3 * size)
      throw std::invalid_argument(fmt::format("the polygon is not planar at corner {}", i));
    if (!(normal.dot((next - here).cross(after - next)) > 0.0))
      throw std::invalid_argument(fmt::format("the polygon is not convex at corner {}", (i + 1) % count));
  }
  TriangleMesh patch{corners, Triangles(count - 2, 3)};
  for (Eigen::Index i = 0; i + 2 < count; ++i)
    patch.triangles.row(i) << 0, static_cast<int>(i + 1), static_cast<int>(i + 2);
  return patch;
}

}  // namespace softbody
