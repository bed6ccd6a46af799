#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Share of the outline of a posed mesh at which the depth image shows no edge of a surface, 0..1: depth runs
/// straight on from inside to outside. It is near 0 at the body's pose, also on a table. Inside a table or a
/// larger object, where a pose may agree in depth, it is large.
double shareWithoutEdge(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose);

/// Largest such share of a pose that is accepted. Noise, and a mesh that is not exact, give up to 0.25.
constexpr double kLargestShareWithoutEdge = 0.35;

/// Smallest extent along a principal axis [m].
double thicknessOf(const Points& vertices);

}  // namespace softbody
