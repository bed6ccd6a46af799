#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_common/parameters.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// How pins are weighed against the camera, and when their frames are faulty.
struct PinOptions {
  double accuracy_m = 0.001;     ///< standard deviation of a pin's position; 0: exact
  double conflict_m = 0.0042;    ///< a pin and the camera that disagree by more are in conflict
  double frame_timeout_s = 1.0;  ///< also of obstacles: time without a pose until a frame is faulty
};

/// What acts on the body, as the simulator's parameters describe it.
struct SurroundingsConfig {
  std::vector<ObstacleDescription> obstacles;
  std::optional<PinRegion> gripper;  ///< the space between the fingers; the fingers are obstacles
  std::string gripper_closed;        ///< topic (std_msgs/Bool) that says whether the gripper is closed
  PinOptions pins;
};

/// @param target_accuracy_m standard deviation of a target of weight 1. @param unknown receives unknown keys
/// of the obstacles and of the gripper's YAML. @throw std::invalid_argument with key, value and allowed
/// values.
SurroundingsConfig readSurroundingsConfig(Parameters& parameters, double target_accuracy_m,
                                          std::vector<std::string>* unknown);

}  // namespace softbody
