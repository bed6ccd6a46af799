#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cutting/split/half_edges.h"

namespace softbody {

/// A triangulated part of the plane and the regions into which the constraints divide it.
struct PlanarTriangulation {
  TriangleList triangles;    ///< counter-clockwise, indices of points
  std::vector<int> regions;  ///< per triangle, 0..
};

/// Constrained Delaunay triangulation of the points' convex hull (CGAL). Coincident points count as the last
/// of them.
/// @return nothing if constraints cross or have no length, a point lies within one, or all points lie on a
/// line.
std::optional<PlanarTriangulation> triangulatePlane(const std::vector<Eigen::Vector2d>& points,
                                                    const std::vector<std::array<int, 2>>& constraints);

}  // namespace softbody
