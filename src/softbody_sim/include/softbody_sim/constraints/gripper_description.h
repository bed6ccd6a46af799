#pragma once

#include <optional>
#include <vector>

#include "softbody_common/parameters.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// The parameters `gripper_...`. The fingers are added to the obstacles.
/// @return the space between the fingers as a pin; empty if there is no gripper.
/// @throw std::invalid_argument with key, value and allowed values.
std::optional<PinRegion> readGripper(Parameters& parameters, std::vector<ObstacleDescription>* obstacles);

}  // namespace softbody
