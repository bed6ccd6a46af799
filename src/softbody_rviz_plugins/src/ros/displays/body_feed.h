#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <boost/function.hpp>
#include <string>

#include "body/shown_body.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {

/// Receives a body's topologies and states in rviz' thread for messages, so that reading them costs the
/// window nothing. A state that is never drawn is never converted.
template <typename TopologyMessage>
class BodyFeed {
 public:
  using TopologyPtr = typename TopologyMessage::ConstPtr;
  using StatePtr = softbody_msgs::MeshState::ConstPtr;
  using News = BodyNews<TopologyPtr, StatePtr>;

  void subscribe(ros::NodeHandle node, const std::string& topology_topic, const std::string& state_topic) {
    unsubscribe();
    topology_ = node.subscribe<TopologyMessage>(
        topology_topic, 1, boost::function<void(const TopologyPtr&)>([this](const TopologyPtr& message) {
          body_.putTopology(message);
        }));
    state_ = node.subscribe<softbody_msgs::MeshState>(
        state_topic, 1,
        boost::function<void(const StatePtr&)>([this](const StatePtr& message) { body_.putState(message); }),
        {}, ros::TransportHints().tcpNoDelay());
  }

  void unsubscribe() {
    topology_.shutdown();
    state_.shutdown();
    body_.clear();
  }

  std::optional<News> take() {
    return body_.take([](const auto& a, const auto& b) { return sameTopology(a, b); });
  }

  std::optional<unsigned> heldRevision() const { return body_.heldRevision(); }

 private:
  ros::Subscriber topology_, state_;
  ShownBody<TopologyPtr, StatePtr> body_;
};

}  // namespace softbody
