#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_common/parameters.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// A gripper: what is between its fingers when it closes is held. The fingers are obstacles.
struct GripperDescription {
  PinRegion space;                           ///< between the fingers, in the gripper's frame [m]
  std::vector<ObstacleDescription> fingers;  ///< boxes in frames of their own
  std::string closed;                        ///< topic (std_msgs/Bool) that says whether it is closed
};

/// The parameter `gripper`, a YAML of a gripper or the frame of one, and the parameters `gripper_...`, which
/// replace what the YAML says. @param unknown receives unknown keys of the YAML.
/// @return empty if there is no gripper. @throw std::invalid_argument with key, value and allowed values.
std::optional<GripperDescription> readGripper(Parameters& parameters, std::vector<std::string>* unknown);

}  // namespace softbody
