#pragma once

#include "softbody_common/types.h"

/// Patches for cuts without a blade, in rest space [m].
namespace softbody {

/// A square in a plane that reaches beyond the body all round. @throw std::invalid_argument if a number is
/// not finite or the normal is zero.
TriangleMesh planePatch(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Points& body);

/// @param corners in order. @throw std::invalid_argument unless they are the corners of a planar, convex
/// polygon.
TriangleMesh polygonPatch(const Points& corners);

}  // namespace softbody
