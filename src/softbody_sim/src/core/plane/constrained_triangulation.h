#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace softbody {

/// A triangulation in the plane, and the regions between the constraints.
struct PlanarTriangulation {
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise, indices of points
  std::vector<int> regions;                   ///< per triangle, 0..
};

/// Constrained Delaunay triangulation of the convex hull of the points (CGAL). The last of coincident points
/// is used. @return nothing if constraints cross or have no length, a point lies inside a constraint, or all
/// points are collinear.
std::optional<PlanarTriangulation> triangulatePlane(const std::vector<Eigen::Vector2d>& points,
                                                    const std::vector<std::array<int, 2>>& constraints);

}  // namespace softbody
