#include "nodes/simulator/reaction_publisher.h"

#include <geometry_msgs/WrenchStamped.h>

#include "softbody_common/ros/geometry_messages.h"
#include "softbody_common/topics.h"

namespace softbody {

Wrench aboutOrigin(const Wrench& wrench, const Eigen::Vector3d& place) {
  return {wrench.force, wrench.torque + place.cross(wrench.force)};
}

ReactionPublisher::ReactionPublisher(ros::NodeHandle node, const std::string& name)
    : publisher_(node.advertise<geometry_msgs::WrenchStamped>(topics::kReaction + name, 10)) {}

void ReactionPublisher::publish(const std::string& frame, const Eigen::Isometry3d& frame_pose,
                                const Wrench& about_origin, const ros::Time& stamp) const {
  const Eigen::Matrix3d to_frame = frame_pose.linear().transpose();
  geometry_msgs::WrenchStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.wrench.force = vectorMessage(to_frame * about_origin.force);
  message.wrench.torque =
      vectorMessage(to_frame * (about_origin.torque - frame_pose.translation().cross(about_origin.force)));
  publisher_.publish(message);
}

}  // namespace softbody
