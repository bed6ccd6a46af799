#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// @param largest_weight allowed weight of a target.
/// @throw std::invalid_argument if the targets do not fit the topology, or a number is not usable.
void requireUsable(const TargetSet& targets, const TetTopology& topology, double largest_weight);

/// Whether a body has left its targets: no target is within reach (reachOf) of its material point.
/// @param vertices of the body [m]; empty: it is not placed, and has left nothing. @param targets usable.
bool hasLeft(const TargetSet& targets, const TetTopology& topology, const Points& vertices);

/// @param vertices of the body [m], or empty. @param targets usable.
/// @throw std::invalid_argument if a target is within reach of its material point neither in the body nor in
/// the rest shape at body_pose.
void requireWithinReach(const TargetSet& targets, const TetTopology& topology, const Points& vertices);

}  // namespace softbody
