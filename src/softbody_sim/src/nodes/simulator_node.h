#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <softbody_msgs/Cut.h>
#include <softbody_msgs/PinRegion.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TetTopology.h>

#include <optional>
#include <string>

#include "nodes/surroundings_tracker.h"
#include "softbody_common/stage_timer.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// Targets in, states of the volumetric model out; without targets, as from a camera that stalls, it goes on
/// at a rate of its own. Carries out cuts. Parameters: ~object, ~body_frame, ~obstacles, ~free_run_rate_hz,
/// ~stall_timeout_s and those of SimulatorConfig.
class SimulatorNode {
 public:
  /// @throw std::invalid_argument if a parameter or a file of the object cannot be used.
  SimulatorNode(ros::NodeHandle node, const ros::NodeHandle& private_node);

 private:
  void onTargets(const softbody_msgs::TargetsConstPtr& message);
  void onCut(const softbody_msgs::CutConstPtr& message);
  void onPin(const softbody_msgs::PinRegionConstPtr& message);
  void step(const softbody_msgs::Targets& message);
  void freeRun();
  void restartIfTimeJumpedBack(const ros::Time& stamp);
  void holdTopologyFrom(const ros::Time& stamp);
  void publishState(const std_msgs::Header& header);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void publishTopology() { topology_publisher_.publish(topology_message_); }

  StageTimer timer_;
  std::optional<Simulator> simulator_;
  std::optional<SurroundingsTracker> surroundings_;
  TargetSet last_targets_;
  std_msgs::Header last_header_;  ///< of those targets
  ros::Time last_arrival_;        ///< and when they came; zero: the body has no place
  double stall_timeout_s_ = 1.0;
  softbody_msgs::TetTopologyPtr topology_message_;  ///< stamp 0 until the body is placed
  ros::Time last_stamp_;  ///< of the last targets that were used since the simulation started
  int steps_ = 0, steps_not_converged_ = 0, refused_ = 0;  ///< since the last diagnosis

  ros::Publisher topology_publisher_, state_publisher_, timing_publisher_;
  ros::Timer topology_timer_, free_run_timer_;
  ros::Subscriber targets_subscriber_, cut_subscriber_, pin_subscriber_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace softbody
