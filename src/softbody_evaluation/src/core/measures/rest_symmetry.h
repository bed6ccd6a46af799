#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// A rigid motion, and how well it maps a mesh onto itself.
struct SelfMap {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  double misfit_m = 0.0;   ///< RMS distance of moved corners and centres of triangles from the mesh
  bool near_start = true;  ///< false if the fit has left the pose where it began
};

/// The rigid motion of the rest shape that takes the result's pose to the truth's: both are fitted to their
/// states. @param rest, result, truth #V by 3, rows of the same vertices [m].
Eigen::Isometry3d motionBetween(const Points& rest, const Points& result, const Points& truth);

/// The motion nearest to `start` that maps the mesh onto itself as well as possible (point-to-plane ICP, Chen
/// and Medioni 1992). A direction in which nothing changes, as the turn of a ball, stays that of `start`.
SelfMap nearestSelfMap(const TriangleMesh& mesh, const Eigen::Isometry3d& start);

/// Whether the mesh looks the same after the motion: the fit stayed where it began, and the misfit is at most
/// 1 % of the mesh's diagonal.
bool isSymmetry(const SelfMap& map, const TriangleMesh& mesh);

}  // namespace softbody::evaluation
