#pragma once

#include <ros/time.h>

#include <string>
#include <utility>

#include "softbody_common/timeline.h"

namespace softbody {

/// Judges the stamps of a topic by the ROS clock, and logs what it refuses and when time jumps back.
class StampGate {
 public:
  /// @param topic name for the log.
  explicit StampGate(std::string topic) : topic_(std::move(topic)) {}

  /// Call it with messages whose content is valid: a message that is refused must not move time.
  StampVerdict judge(const ros::Time& stamp);

  int pass() const { return timeline_.pass(); }

 private:
  bool mayWarn();

  std::string topic_;
  Timeline timeline_;
  ros::SteadyTime last_warning_;
};

}  // namespace softbody
