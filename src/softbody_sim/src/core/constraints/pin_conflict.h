#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// How far the pins of a region and the targets disagree [m]: root mean square, over the pins, of the rigid
/// motion that best moves the pins to where the targets see their vertices. What no target sees counts as
/// agreement. @param vertices #V by 3, after a step under both [m]. @param pins in ascending order of their
/// vertices.
double pinConflict(const std::vector<Target>& targets, const Tets& tets, const Points& vertices,
                   const std::vector<Pin>& pins);

}  // namespace softbody
