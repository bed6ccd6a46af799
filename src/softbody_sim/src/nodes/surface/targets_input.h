#pragma once

#include <ros/ros.h>
#include <softbody_msgs/Targets.h>

#include <deque>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Subscribes to the targets: the simulator's states follow them.
class TargetsInput {
 public:
  explicit TargetsInput(ros::NodeHandle node);

  /// The targets that led to a state of this stamp and frame; empty if they have not come or cannot be used.
  TargetSet of(const std_msgs::Header& header) const;

 private:
  void onTargets(const softbody_msgs::TargetsConstPtr& message);

  std::deque<softbody_msgs::TargetsConstPtr> last_;  ///< oldest first
  ros::Subscriber subscriber_;
};

}  // namespace softbody
