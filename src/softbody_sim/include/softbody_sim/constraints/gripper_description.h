#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// A gripper: what is between its fingers when it closes is held. The fingers are obstacles.
struct GripperDescription {
  PinRegion space;                           ///< between the fingers, in the gripper's frame [m]
  std::vector<ObstacleDescription> fingers;  ///< boxes in frames of their own
  std::string closed;                        ///< topic (std_msgs/Bool) that says whether it is closed
};

/// @param gripper YAML of a gripper (.yaml or .yml), or the frame of one without fingers; empty: none.
/// @param unknown gets the keys of the YAML that have no meaning.
/// @throw std::invalid_argument with file, key, value and what is allowed.
std::optional<GripperDescription> readGripper(const std::string& gripper, std::vector<std::string>* unknown);

}  // namespace softbody
