#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Whether the frame shows the body at a pose where it is expected: what nothing hides agrees, and the pose
/// is confined. It may be half hidden, and others may touch it.
bool isShown(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose);

/// Whether the body stands free at a pose: all that the mesh covers agrees, and the outline has edges.
/// Elsewhere nothing but its shape tells the body from other things, so what hides it speaks against it.
bool standsFree(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose);

/// PoseCost in which a pixel where something is nearer costs nearly as much as one where the camera sees
/// through the mesh.
double freeCost(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose);

}  // namespace softbody
