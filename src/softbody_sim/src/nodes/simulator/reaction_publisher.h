#pragma once

#include <ros/ros.h>

#include <Eigen/Geometry>
#include <string>

#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// The same wrench about the origin of the targets' frame. @param place its reference point [m].
Wrench aboutOrigin(const Wrench& wrench, const Eigen::Vector3d& place);

/// Publishes the body's force and torque on one pin or obstacle. The topic ends with this object.
class ReactionPublisher {
 public:
  ReactionPublisher(ros::NodeHandle node, const std::string& name);

  bool isListenedTo() const { return publisher_.getNumSubscribers() > 0; }

  /// Publishes a wrench in a frame, about the frame's origin: what a sensor there would measure.
  /// @param frame_pose in the targets' frame. @param about_origin wrench about the origin of the targets'
  /// frame.
  void publish(const std::string& frame, const Eigen::Isometry3d& frame_pose, const Wrench& about_origin,
               const ros::Time& stamp) const;

 private:
  ros::Publisher publisher_;
};

}  // namespace softbody
