#pragma once

#include <ros/ros.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TetTopology.h>

#include <optional>
#include <string>

#include "softbody_common/stage_timer.h"
#include "softbody_sim/simulator.h"

namespace softbody {

/// Targets in, states of the volumetric model out. Parameters: ~object, ~body_frame and those of
/// SimulatorConfig.
class SimulatorNode {
 public:
  /// @throw std::invalid_argument if a parameter or a file of the object cannot be used.
  SimulatorNode(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  void onTargets(const softbody_msgs::TargetsConstPtr& message);
  void restartIfTimeJumpedBack(const ros::Time& stamp);
  void step(const softbody_msgs::Targets& message);
  void publishState(const std_msgs::Header& header);
  void publishTopology() { topology_publisher_.publish(topology_message_); }

  StageTimer timer_;
  std::optional<Simulator> simulator_;
  softbody_msgs::TetTopologyPtr topology_message_;
  ros::Time last_stamp_;

  ros::Publisher topology_publisher_, state_publisher_, timing_publisher_;
  ros::Timer topology_timer_;
  ros::Subscriber targets_subscriber_;
};

}  // namespace softbody
