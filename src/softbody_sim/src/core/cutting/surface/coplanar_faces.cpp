#include "cutting/surface/coplanar_faces.h"

#include <algorithm>

namespace softbody {
namespace {

constexpr double kParallel = 1e-3;  // sine of the angle between planes

struct FlatTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  Eigen::Vector3d normal;  ///< unit, or zero

  FlatTriangle(const std::vector<Eigen::Vector3d>& points, const std::array<int, 3>& triangle)
      : corners{points[triangle[0]], points[triangle[1]], points[triangle[2]]},
        normal((corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized()) {}

  Eigen::Vector3d middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }

  /// Whether the point lies above or below the triangle, within a distance.
  bool isNear(const Eigen::Vector3d& point, double distance) const {
    if (std::abs(normal.dot(point - corners[0])) > distance) return false;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d edge = corners[(k + 1) % 3] - corners[k];
      if (normal.dot(edge.cross(point - corners[k])) < 0.0) return false;
    }
    return true;
  }
};

/// The triangles of the surface that are parallel to a facet and meet the bounding box of the fill.
std::vector<FlatTriangle> candidates(const SplitSurface& surface, const CutFill& fill,
                                     const std::vector<Eigen::Vector3d>& normals, double distance) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : fill.triangles) {
    for (const int p : triangle) box.extend(fill.points[p]);
  }
  box.min().array() -= distance;
  box.max().array() += distance;
  std::vector<unsigned char> beyond;  // per vertex, a bit for each side of the box that it is beyond
  beyond.reserve(surface.vertices.size());
  for (const Eigen::Vector3d& v : surface.vertices) {
    unsigned sides = 0;
    for (int axis = 0; axis < 3; ++axis) {
      sides |= static_cast<unsigned>(v[axis] < box.min()[axis]) << axis;
      sides |= static_cast<unsigned>(v[axis] > box.max()[axis]) << (3 + axis);
    }
    beyond.push_back(static_cast<unsigned char>(sides));
  }
  std::vector<FlatTriangle> found;
  for (const auto& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle;
    if (a < 0 || (beyond[a] & beyond[b] & beyond[c]) != 0) continue;
    const FlatTriangle flat(surface.vertices, triangle);
    const auto parallel = [&flat](const Eigen::Vector3d& n) {
      return n.cross(flat.normal).norm() < kParallel;
    };
    if (std::any_of(normals.begin(), normals.end(), parallel)) found.push_back(flat);
  }
  return found;
}

}  // namespace

CoplanarFaces findCoplanarFaces(const SplitSurface& surface, const CutFill& fill, const PatchFacets& facets,
                                double distance) {
  std::vector<Eigen::Vector3d> normals;
  for (const PlaneFrame& frame : facets.frames) normals.push_back(frame.x_axis.cross(frame.y_axis));
  const std::vector<FlatTriangle> near = candidates(surface, fill, normals, distance);
  CoplanarFaces coplanar;
  for (std::size_t t = 0; t < fill.triangles.size(); ++t) {
    const Eigen::Vector3d& normal = normals[fill.facets[t]];
    const Eigen::Vector3d middle = FlatTriangle(fill.points, fill.triangles[t]).middle();
    for (const FlatTriangle& other : near) {
      if (normal.cross(other.normal).norm() > kParallel || !other.isNear(middle, distance)) continue;
      if (coplanar.count++ == 0) coplanar.outward = other.normal;
      break;
    }
  }
  return coplanar;
}

}  // namespace softbody
