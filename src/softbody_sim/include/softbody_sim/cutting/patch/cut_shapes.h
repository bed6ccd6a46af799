#pragma once

#include "softbody_common/geometry/types.h"

/// Cut patches that do not come from a blade, in rest space [m].
namespace softbody {

/// A square in a plane, larger than the body. @throw std::invalid_argument if a number is not finite or the
/// normal is zero.
TriangleMesh planePatch(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Points& body);

/// A planar, convex polygon. @param corners in order. @throw std::invalid_argument if it is not planar or not
/// convex.
TriangleMesh polygonPatch(const Points& corners);

}  // namespace softbody
