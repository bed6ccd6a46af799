#pragma once

#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_srvs/SetBool.h>

#include <optional>

#include "nodes/simulator/surroundings_tracker.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// A gripper that others open and close: on a topic, which counts when it changes, or by the service ~grip.
/// Closed, it holds what lies between its fingers.
class GripperInput {
 public:
  /// @param config with a gripper. @param simulator, surroundings outlive this.
  GripperInput(ros::NodeHandle node, ros::NodeHandle private_node, const SurroundingsConfig& config,
               const Simulator* simulator, SurroundingsTracker* surroundings);

 private:
  void onClosed(const std_msgs::BoolConstPtr& message);
  bool onGrip(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  std::size_t close();

  PinRegion gripper_;
  const Simulator* simulator_;
  SurroundingsTracker* surroundings_;
  std::optional<bool> said_closed_;  ///< the last message
  ros::Subscriber closed_;
  ros::ServiceServer grip_;
};

}  // namespace softbody
