#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// How much the frame keeps a posed mesh from sliding in the image: by how much its PoseCost rises if it is
/// shifted or turned there, divided by how much that of a body rises that stands free. Each motion counts
/// together with its opposite; of all the smallest share. 1: the body stands free; 0: the mesh may slide, as
/// on a table; a half if one of two ends is hidden, or touches something that continues its surface.
double confinement(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose);

/// Least confinement of a pose where the body is expected: with less, hardly an edge is seen.
constexpr double kLeastConfinement = 0.2;

}  // namespace softbody
