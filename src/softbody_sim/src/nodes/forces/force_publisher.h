#pragma once

#include <ros/ros.h>

#include <string>

#include "nodes/simulator/surroundings_tracker.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/forces/force_schedule.h"

namespace softbody {

/// Estimates the external forces a few times a second while somebody listens to them, or to what the pins
/// carry, and publishes them with arrows for rviz.
class ForcePublisher {
 public:
  /// @param wrench_frame of the net wrench; empty: the frame of the targets.
  ForcePublisher(ros::NodeHandle node, const std::string& wrench_frame);

  /// @param targets, @param header of the last step. @param reactions of the step; those of the pins become
  /// those of the body without the targets' springs, or none between two estimates.
  /// @throw as Simulator::externalForces().
  void publish(const TargetSet& targets, const std_msgs::Header& header,
               const SurroundingsTracker& surroundings, Simulator* simulator, Reactions* reactions);

 private:
  bool isListenedTo() const;
  void forget(const std_msgs::Header& header);
  void send(ForceEstimate estimate, const std_msgs::Header& header, const SurroundingsTracker& surroundings);

  const std::string wrench_frame_;
  ros::Publisher forces_, markers_;
  ForceSchedule schedule_;
  ros::SteadyTime rests_until_;  ///< stamps may stand still or start again
  bool shows_arrows_ = false;
};

}  // namespace softbody
