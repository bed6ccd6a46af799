#pragma once

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// A piece under loads without pin, target or obstacle has no static equilibrium.
/// @param loads #V by 3 [N]. @throw std::invalid_argument that names the piece.
void requireHeld(const TetTopology& topology, const std::vector<Target>& targets,
                 const Surroundings& surroundings, const Points& loads);

}  // namespace softbody
