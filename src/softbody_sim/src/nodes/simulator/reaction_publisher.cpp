#include "nodes/simulator/reaction_publisher.h"

#include "softbody_common/protocol/topics.h"
#include "softbody_sim/ros/force_messages.h"

namespace softbody {

ReactionPublisher::ReactionPublisher(ros::NodeHandle node, const std::string& name)
    : publisher_(node.advertise<geometry_msgs::WrenchStamped>(topics::kReaction + name, 10)) {}

void ReactionPublisher::publish(const NamedReaction& reaction, const std::string& target_frame,
                                const ros::Time& stamp) const {
  geometry_msgs::WrenchStamped message = toMessage(reaction, target_frame);
  message.header.stamp = stamp;
  publisher_.publish(message);
}

}  // namespace softbody
