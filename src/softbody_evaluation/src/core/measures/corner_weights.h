#pragma once

#include <Eigen/Geometry>
#include <array>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// The same for a triangle of a mesh.
inline Eigen::Vector3d cornerWeights(const Points& vertices, const std::array<int, 3>& corners,
                                     const Eigen::Vector3d& p) {
  return softbody::cornerWeights(p, vertices.row(corners[0]).transpose(),
                                 vertices.row(corners[1]).transpose(), vertices.row(corners[2]).transpose());
}

}  // namespace softbody::evaluation
