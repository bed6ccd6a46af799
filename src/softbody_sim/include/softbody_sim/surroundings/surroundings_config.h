#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_sim/constraints/gripper_description.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// What acts on the body.
struct SurroundingsConfig {
  std::vector<ObstacleDescription> obstacles;  ///< with the fingers of the gripper
  std::optional<PinRegion> gripper;            ///< the space between the fingers
  std::string gripper_closed;                  ///< topic (std_msgs/Bool) that says whether it is closed
  double pin_accuracy_m = 0.001;               ///< standard deviation of a pin's position; 0: exact
  /// Keys of obstacles and of the gripper's YAML that have no meaning. The caller should warn about them.
  std::vector<std::string> unknown;
};

const ParameterTable<SurroundingsConfig>& surroundingsParameters();

}  // namespace softbody
