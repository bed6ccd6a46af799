#pragma once

#include <Eigen/Geometry>
#include <array>

#include "softbody_common/types.h"

namespace softbody::evaluation {

/// Barycentric coordinates of a point of a triangle: areas opposite to the corners, sum 1.
inline Eigen::Vector3d cornerWeights(const Points& vertices, const std::array<int, 3>& corners,
                                     const Eigen::Vector3d& p) {
  const Eigen::Vector3d a = vertices.row(corners[0]), b = vertices.row(corners[1]),
                        c = vertices.row(corners[2]);
  const Eigen::Vector3d areas((b - p).cross(c - p).norm(), (c - p).cross(a - p).norm(),
                              (a - p).cross(b - p).norm());
  return areas.sum() > 0.0 ? Eigen::Vector3d(areas / areas.sum()) : Eigen::Vector3d::UnitX();
}

}  // namespace softbody::evaluation
