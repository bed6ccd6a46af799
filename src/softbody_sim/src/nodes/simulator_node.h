#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
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
  void step(const softbody_msgs::Targets& message);
  void restartIfTimeJumpedBack(const ros::Time& stamp);
  void publishState(const std_msgs::Header& header);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void publishTopology() { topology_publisher_.publish(topology_message_); }

  StageTimer timer_;
  std::optional<Simulator> simulator_;
  softbody_msgs::TetTopologyPtr topology_message_;
  ros::Time last_stamp_;  ///< of the last step that succeeded since the simulation started
  int steps_ = 0, steps_not_converged_ = 0, refused_ = 0;  ///< since the last diagnosis

  ros::Publisher topology_publisher_, state_publisher_, timing_publisher_;
  ros::Timer topology_timer_;
  ros::Subscriber targets_subscriber_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace softbody
