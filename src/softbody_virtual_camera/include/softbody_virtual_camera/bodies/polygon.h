#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace softbody::virtual_camera {

/// Triangles of a simple polygon, counter-clockwise, by its vertices alone (no new ones): ears are clipped,
/// then edges flipped until none would make the lower of its triangles higher, so that no sliver is left.
/// Vertices may lie on a line with their neighbours.
/// @throw std::invalid_argument if the polygon is clockwise or crosses itself.
std::vector<std::array<int, 3>> triangulatePolygon(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace softbody::virtual_camera
