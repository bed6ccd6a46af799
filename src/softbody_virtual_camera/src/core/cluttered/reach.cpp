#include "cluttered/reach.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <vector>

#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
using Polygon = std::vector<Eigen::Vector3d>;

/// The part of a convex polygon with side * p[axis] <= limit (Sutherland and Hodgman 1974).
Polygon clippedAt(const Polygon& polygon, int axis, double side, double limit) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double before = limit - side * from[axis], after = limit - side * to[axis];
    if (before >= 0.0) kept.push_back(from);
    if ((before > 0.0 && after < 0.0) || (before < 0.0 && after > 0.0))
      kept.push_back(from + before / (before - after) * (to - from));
  }
  return kept;
}

}  // namespace

double reachOf(const TriangleMesh& surface, const Eigen::Isometry3d& T_surface_face,
               const Eigen::Vector2d& half) {
  const Points places = transformed(T_surface_face.inverse(), surface.vertices);
  double reach = kNothing;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    Polygon corners;
    for (int k = 0; k < 3; ++k) corners.emplace_back(places.row(surface.triangles(f, k)).transpose());
    for (const int axis : {0, 1}) {
      for (const double side : {1.0, -1.0}) corners = clippedAt(corners, axis, side, half[axis]);
    }
    for (const Eigen::Vector3d& corner : corners) reach = std::max(reach, corner.z());
  }
  return reach == kNothing ? places.col(2).maxCoeff() : reach;
}

}  // namespace softbody::virtual_camera
