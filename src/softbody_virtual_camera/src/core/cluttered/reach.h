#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// How far a surface reaches along z of a frame, where |x| and |y| are at most those of `half` [m]: a flat
/// face there touches it. Where nothing is, the largest z of the whole surface.
double reachOf(const TriangleMesh& surface, const Eigen::Isometry3d& T_surface_face,
               const Eigen::Vector2d& half);

}  // namespace softbody::virtual_camera
