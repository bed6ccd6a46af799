#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Closed surfaces about the origin, outward. Round ones lie inside the solid, at most 0.5 mm or 1 % of the
/// radius, whichever is more.
TriangleMesh boxMesh(const Eigen::Vector3d& size);
/// @param length along z [m].
TriangleMesh cylinderMesh(double radius, double length);
TriangleMesh sphereMesh(double radius);

/// Adds a mesh to another one.
void append(const TriangleMesh& part, TriangleMesh* whole);

}  // namespace softbody
