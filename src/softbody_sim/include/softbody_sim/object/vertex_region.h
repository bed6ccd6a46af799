#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The box of a region: "all", or conditions that all hold, such as "x<0.01" or "x>=0.9 & z>0.05" [m]. Both
/// ends are included; a side without a condition is infinite.
/// @throw std::invalid_argument with the condition that cannot be read.
Eigen::AlignedBox3d boxOf(const std::string& region);

/// The vertex nearest to a box, in words: its distance from the box, its number and its place.
/// @param vertices #V by 3, at least one, in the frame of the box [m].
std::string nearestVertex(const Eigen::AlignedBox3d& box, const Points& vertices);

/// Vertices in a region. @throw std::invalid_argument as boxOf does, or, with the vertex nearest to it, if
/// the region has no vertex.
std::vector<int> verticesWhere(const std::string& region, const Points& vertices);

}  // namespace softbody
