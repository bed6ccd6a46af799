#include "robot/robot_view.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

// [m] Depth cameras for the hand measure from 0.07 to 0.17 m on.
constexpr double kNearestLink_m = 0.1;

double distanceToSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp(-a.dot(along) / length2, 0.0, 1.0) : 0.0;
  return (a + t * along).norm();
}

/// Distance of the origin.
double distanceToTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const bool is_above = normal.squaredNorm() > 0.0 && a.cross(b).dot(normal) >= 0.0 &&
                        b.cross(c).dot(normal) >= 0.0 && c.cross(a).dot(normal) >= 0.0;
  if (is_above) return std::abs(a.dot(normal)) / normal.norm();
  return std::min({distanceToSegment(a, b), distanceToSegment(b, c), distanceToSegment(c, a)});
}

/// Signed solid angle seen from the origin (Van Oosterom and Strackee 1983).
double solidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

bool holdsCamera(const TriangleMesh& link, const Eigen::Vector3d& camera) {
  const Eigen::Vector3d lowest = link.vertices.colwise().minCoeff(),
                        highest = link.vertices.colwise().maxCoeff();
  const Eigen::Vector3d outside = (lowest - camera).cwiseMax(camera - highest).cwiseMax(0.0);
  if (outside.norm() >= kNearestLink_m) return false;
  double angle = 0.0;
  for (const auto& triangle : link.triangles.rowwise()) {
    const Eigen::Vector3d a = link.vertices.row(triangle(0)).transpose() - camera;
    const Eigen::Vector3d b = link.vertices.row(triangle(1)).transpose() - camera;
    const Eigen::Vector3d c = link.vertices.row(triangle(2)).transpose() - camera;
    if (distanceToTriangle(a, b, c) < kNearestLink_m) return true;
    angle += solidAngle(a, b, c);
  }
  return std::abs(angle) > 2.0 * M_PI;  // 4 pi inside a closed surface, 0 outside
}

}  // namespace softbody
