#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A point outside of a tet mesh and the nearest place on the mesh's boundary.
struct OutsidePoint {
  Eigen::Index point = 0;
  int triangle = -1;  ///< of the boundary
  Eigen::Vector3d on_boundary = Eigen::Vector3d::Zero();
  double distance = 0.0;  ///< [m]
};

/// The points that lie outside of the tets by more than 1e-9 of the mesh's size.
/// @param boundary of the tets.
std::vector<OutsidePoint> pointsOutside(const Points& points, const TetMesh& mesh, const Triangles& boundary);

/// Largest distance, 0 if the list is empty [m].
double largestDistance(const std::vector<OutsidePoint>& outside);

}  // namespace softbody
