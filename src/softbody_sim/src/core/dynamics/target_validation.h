#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// @param largest_weight allowed weight of a target.
/// @throw std::invalid_argument if the targets do not fit the topology, or a number is not usable.
void requireUsable(const TargetSet& targets, const TetTopology& topology, double largest_weight);

}  // namespace softbody
