#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// What describes a gripper, as its YAML and the parameters say it.
struct GripperWords {
  std::string frame;    ///< Empty if there is no gripper.
  std::string fingers;  ///< frames, separated by spaces
  /// Space between the fingers: lowest, then highest x, y, z in the gripper's frame [m].
  Eigen::Matrix<double, 6, 1> box =
      (Eigen::Matrix<double, 6, 1>() << -0.02, -0.05, -0.03, 0.02, 0.05, 0.03).finished();
  Eigen::Vector3d finger_size{0.02, 0.01, 0.06};  ///< along x, y, z of a finger's frame [m]
  std::string closed = topics::kGripperClosed;
  std::vector<std::string> unknown;  ///< keys of the YAML that have no meaning
};

/// The parameter `gripper`, a YAML of a gripper or the frame of one, and the parameters `gripper_...`, which
/// replace what the YAML says.
const ParameterTable<GripperWords>& gripperParameters();

/// A gripper: what is between its fingers when it closes is held. The fingers are obstacles.
struct GripperDescription {
  PinRegion space;                           ///< between the fingers, in the gripper's frame [m]
  std::vector<ObstacleDescription> fingers;  ///< boxes in frames of their own
  std::string closed;                        ///< topic (std_msgs/Bool) that says whether it is closed
};

/// @return empty if there is no gripper.
std::optional<GripperDescription> gripperOf(const GripperWords& words);

}  // namespace softbody
