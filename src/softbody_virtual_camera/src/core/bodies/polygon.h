#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace softbody::virtual_camera {

/// Triangulates a simple, counter-clockwise polygon without new vertices. Clips ears. Then flips edges while
/// a flip increases the smaller height of the two triangles; this removes slivers. Vertices may be collinear
/// with their neighbours.
/// @throw std::invalid_argument if the polygon is clockwise or crosses itself.
std::vector<std::array<int, 3>> triangulatePolygon(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace softbody::virtual_camera
