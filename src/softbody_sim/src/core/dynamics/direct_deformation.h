#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Deformation without simulation (Kang et al. 2022, Fig. 6): every surface vertex in a target's tet moves by
/// the mean of its targets' offsets, weighted with the targets' weights and barycentric coordinates. No other
/// vertex moves.
void moveToTargets(const std::vector<Target>& targets, const TetTopology& topology, Points* vertices);

}  // namespace softbody
