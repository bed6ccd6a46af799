#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Whether a link holds the camera, like a robot's hand: the camera's centre is inside the link's surface, or
/// nearer than 0.1 m to it, where a depth camera measures nothing. Such a link would cover everything. @param
/// camera its centre in the link's frame [m].
bool holdsCamera(const TriangleMesh& link, const Eigen::Vector3d& camera);

}  // namespace softbody
