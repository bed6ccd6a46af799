#pragma once

#include <ros/ros.h>

#include <string>

#include "softbody_sim/surroundings/named_surroundings.h"

namespace softbody {

/// Publishes the body's force and torque on one pin or obstacle. The topic ends with this object.
class ReactionPublisher {
 public:
  ReactionPublisher(ros::NodeHandle node, const std::string& name);

  bool isListenedTo() const { return publisher_.getNumSubscribers() > 0; }

  /// @param target_frame of the targets.
  void publish(const NamedReaction& reaction, const std::string& target_frame, const ros::Time& stamp) const;

 private:
  ros::Publisher publisher_;
};

}  // namespace softbody
