#pragma once

#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// Pure bending about the y axis: the plane z = 0 becomes a cylinder of this curvature [1/m] and keeps its
/// lengths along x; the cross-sections stay plane and normal to it. The origin and its tangent plane stay
/// where they are; with a positive curvature the ends move towards +z. Any |curvature| < 1 / |z|, zero
/// included.
Eigen::Vector3d bend(const Eigen::Vector3d& rest, double curvature);

/// Still for half a second, then one smooth bend to +7 1/m and back and one to -7 1/m and back, 5 s in all,
/// over and over.
double bendCurvature(double t);

}  // namespace softbody::virtual_camera
