#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace softbody::bench {

/// Constrained Delaunay triangulation by CGAL alone: all points and constraints in one call.
/// @return number of triangles.
std::size_t cgalTriangulation(const std::vector<Eigen::Vector2d>& points,
                              const std::vector<std::array<int, 2>>& constraints);

}  // namespace softbody::bench
