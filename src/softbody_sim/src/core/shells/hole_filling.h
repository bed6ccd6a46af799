#pragma once

#include "surface_mesh/surface_repair.h"

namespace softbody {

/// What was filled.
struct FilledHoles {
  int count = 0;
  double widest = 0.0;                              ///< diagonal of the box around the widest rim [mesh unit]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< middle of that rim
};

/// Closes every ring of open edges with triangles between its vertices: flat rims by a constrained Delaunay
/// triangulation, others by a search in the 3D Delaunay triangulation (CGAL). Where both fail, the triangles
/// join the rim with its middle, a new vertex without a parent. New corners take the texture of the rim.
FilledHoles fillHoles(WeldedSurface* surface);

}  // namespace softbody
