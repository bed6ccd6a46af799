#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_sim/constraints/gripper_description.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// How pins are weighed against the camera, and when their frames are faulty.
struct PinOptions {
  double accuracy_m = 0.001;     ///< standard deviation of a pin's position; 0: exact
  double conflict_m = 0.0042;    ///< a pin and the camera that disagree by more are in conflict
  double frame_timeout_s = 1.0;  ///< also of obstacles: time without a pose until a frame is faulty
};

/// What acts on the body.
struct SurroundingsConfig {
  std::vector<ObstacleDescription> obstacles;
  std::optional<PinRegion> gripper;  ///< the space between the fingers; the fingers are obstacles
  std::string gripper_closed;        ///< topic (std_msgs/Bool) that says whether the gripper is closed
  PinOptions pins;
};

/// The simulator's parameters of what acts on the body.
struct SurroundingsParameters {
  std::vector<ObstacleDescription> obstacles;
  std::vector<std::string> unknown;  ///< keys of obstacles that have no meaning
  GripperWords gripper;
  PinOptions pins;
};

const ParameterTable<SurroundingsParameters>& surroundingsParameters();

/// Keys of obstacles and of the gripper's YAML that have no meaning. The caller should warn about them.
std::vector<std::string> unknownKeys(const SurroundingsParameters& parameters);

/// @param target_accuracy_m standard deviation of a target of weight 1.
SurroundingsConfig surroundingsOf(const SurroundingsParameters& parameters, double target_accuracy_m);

}  // namespace softbody
