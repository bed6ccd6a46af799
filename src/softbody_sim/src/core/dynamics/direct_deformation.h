#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Deformation without simulation (Kang et al. 2022, Fig. 6). Each surface vertex of a target's tet moves by
/// the mean offset of its targets, weighted by target weight and barycentric coordinate. Other vertices stay.
void moveToTargets(const std::vector<Target>& targets, const TetTopology& topology, Points* vertices);

}  // namespace softbody
