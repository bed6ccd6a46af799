#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

constexpr double kFistLength = 0.045;  ///< of the end that a fist encloses [m]

/// A fist with its arm, closed around the end of a body along x. It hides the whole end.
/// @param body in its frame. @param outward 1: the end at positive x; -1: the other one.
TriangleMesh makeFist(const Points& body, double outward);

}  // namespace softbody::virtual_camera
