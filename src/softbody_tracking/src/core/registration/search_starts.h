#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "registration/coarse_mesh.h"

namespace softbody {

/// Rotation vectors [rad] that turn a rough pose by kOtherTurn about each axis; the first one is zero.
std::vector<Eigen::Vector3d> smallTurns();

/// Shifts across the line of sight, on a square grid without its middle. @param reach_m largest along x and
/// y,
/// @param spacing_m smallest; there are at most 24 shifts.
std::vector<Eigen::Vector3d> shiftsWithin(double reach_m, double spacing_m);

/// The body in every orientation, so that the camera sees it around a point. Some start is within about 35
/// degrees of any orientation.
/// @param visible_center mean of the visible points, camera frame [m].
std::vector<Eigen::Isometry3d> allOrientations(const SearchMeshes& meshes,
                                               const Eigen::Vector3d& visible_center);

}  // namespace softbody
