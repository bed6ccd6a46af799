#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// @param rest of the topology, #V by 3 [m].
/// @throw std::invalid_argument if a state is not of a topology, or if nobody could see the body in it: its
/// vertices are all at one place, or one of them is far from the others.
void requireDrawable(const MeshState& state, std::uint32_t revision, const Points& rest);

}  // namespace softbody
