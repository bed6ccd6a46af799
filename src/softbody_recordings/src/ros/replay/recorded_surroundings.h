#pragma once

#include <rosbag/bag.h>

#include <functional>
#include <map>
#include <string>

#include "softbody_recordings/pipeline/body_surroundings.h"
#include "softbody_recordings/ros/bag_transforms.h"

namespace softbody {

/// What a bag knows of a body's surroundings: poses of frames, and whether the gripper is closed. What it
/// does not know at a stamp is empty.
class RecordedSurroundings {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// @param config of the surroundings. The messages on the topic of its gripper have no stamp, so the times
  /// of recording count.
  /// @param warn called with refused transforms, and if the topic has no message.
  /// @throw std::exception with the path if the bag cannot be read, or the topic has another type.
  RecordedSurroundings(const rosbag::Bag& bag, const SurroundingsConfig& config, const Warn& warn);

  /// @param fixed_frame of targets and states. The result must not outlive this object.
  SurroundingsInput at(const std::string& fixed_frame, const ros::Time& stamp) const;

 private:
  BagTransforms transforms_;
  std::map<ros::Time, bool> closed_;  ///< by time of recording
};

}  // namespace softbody
