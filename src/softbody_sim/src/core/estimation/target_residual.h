#pragma once

#include <Eigen/Core>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// From the target's material point, on the vertices, #V by 3, to where it was measured [m]. With a normal,
/// only the part along it.
Eigen::Vector3d residualOf(const Target& target, const Tets& tets, const Points& vertices);

}  // namespace softbody
