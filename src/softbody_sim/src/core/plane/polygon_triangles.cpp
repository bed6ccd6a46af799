#include "plane/polygon_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "plane/constrained_triangulation.h"

namespace softbody {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

constexpr Eigen::Index kMostCorners = 10000;  // the regions of hostile polygons take corners^2 steps
constexpr double kFlatShare = 1e-9;           // of the polygon's area: well above rounding

/// Twice the vector area (Newell's method).
Eigen::Vector3d areaVector(const Points& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 2; k < corners.rows(); ++k) {
    const Eigen::Vector3d a = corners.row(k - 1) - corners.row(0), b = corners.row(k) - corners.row(0);
    sum += a.cross(b);
  }
  return sum;
}

/// A fan from the corner with the smallest coordinates, wherever the polygon begins.
std::vector<std::array<int, 3>> fan(const Points& corners) {
  const int count = static_cast<int>(corners.rows());
  int first = 0;
  for (int k = 1; k < count; ++k) {
    const auto a = corners.row(k), b = corners.row(first);
    if (std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end())) first = k;
  }
  std::vector<std::array<int, 3>> triangles;
  for (int k = 2; k < count; ++k) triangles.push_back({first, (first + k - 1) % count, (first + k) % count});
  return triangles;
}

/// Whether all triangles are turned as the polygon: then a fan has no overlaps.
bool turnAlike(const std::vector<std::array<int, 3>>& triangles, const Points& corners,
               const Eigen::Vector3d& normal) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const std::array<int, 3>& t) {
    const Eigen::Vector3d ab = corners.row(t[1]) - corners.row(t[0]),
                          ac = corners.row(t[2]) - corners.row(t[0]);
    return ab.cross(ac).dot(normal) > kFlatShare * normal.squaredNorm();
  });
}

Polygon projected(const Points& corners, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
  Polygon polygon;
  for (const auto& row : corners.rowwise()) {
    const Eigen::Vector3d corner = row - corners.row(0);
    polygon.emplace_back(corner.dot(x), corner.dot(y));
  }
  return polygon;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Even-odd rule: the edges of a bridge to a hole cancel.
bool isInside(const Eigen::Vector2d& point, const Polygon& polygon) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d a = polygon[k] - point, b = polygon[(k + 1) % polygon.size()] - point;
    if ((a.y() > 0.0) != (b.y() > 0.0) && (cross(a, b) > 0.0) == (b.y() > a.y())) inside = !inside;
  }
  return inside;
}

/// The triangles of the regions inside. The largest triangle of a region is the one that is surely on one
/// side.
std::vector<std::array<int, 3>> insideTriangles(const PlanarTriangulation& plane, const Polygon& polygon) {
  std::vector<double> largest(plane.regions.size(), 0.0);
  std::vector<bool> inside(plane.regions.size(), false);
  for (std::size_t t = 0; t < plane.triangles.size(); ++t) {
    const auto& [a, b, c] = plane.triangles[t];
    const double area = cross(polygon[b] - polygon[a], polygon[c] - polygon[a]);
    const auto region = static_cast<std::size_t>(plane.regions[t]);
    if (!(area > largest[region])) continue;
    largest[region] = area;
    inside[region] = isInside((polygon[a] + polygon[b] + polygon[c]) / 3.0, polygon);
  }
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t t = 0; t < plane.triangles.size(); ++t) {
    if (inside[static_cast<std::size_t>(plane.regions[t])]) triangles.push_back(plane.triangles[t]);
  }
  return triangles;
}

}  // namespace

PolygonTriangles polygonTriangles(const Points& corners) {
  if (corners.rows() == 3) return {{{0, 1, 2}}, true};
  const Eigen::Vector3d normal = areaVector(corners);
  PolygonTriangles result{fan(corners), true};
  if (turnAlike(result.triangles, corners, normal)) return result;
  result.is_exact = false;
  if (!(normal.norm() > 0.0) || corners.rows() > kMostCorners) return result;
  const Polygon polygon = projected(corners, normal);
  std::vector<std::array<int, 2>> edges;
  for (int k = 0; k < static_cast<int>(polygon.size()); ++k) {
    const int next = (k + 1) % static_cast<int>(polygon.size());
    if (polygon[k] != polygon[next]) edges.push_back({k, next});
  }
  const auto plane = triangulatePlane(polygon, edges);
  if (plane) result = {insideTriangles(*plane, polygon), true};
  return result;
}

}  // namespace softbody
