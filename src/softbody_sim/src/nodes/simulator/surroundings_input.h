#pragma once

#include <ros/ros.h>
#include <softbody_msgs/Pin.h>
#include <softbody_msgs/PinRegion.h>
#include <softbody_msgs/Release.h>
#include <softbody_msgs/SetObstacle.h>

#include "nodes/simulator/surroundings_tracker.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// Pins and obstacles that others set while the node runs: the topic `pin`, and the services ~pin,
/// ~set_obstacle and ~release.
class SurroundingsInput {
 public:
  /// @param simulator, surroundings outlive this.
  SurroundingsInput(ros::NodeHandle node, ros::NodeHandle private_node, const Simulator* simulator,
                    SurroundingsTracker* surroundings);

 private:
  void onPinMessage(const softbody_msgs::PinRegionConstPtr& message);
  bool onPin(softbody_msgs::Pin::Request& request, softbody_msgs::Pin::Response& response);
  bool onSetObstacle(softbody_msgs::SetObstacle::Request& request,
                     softbody_msgs::SetObstacle::Response& response);
  bool onRelease(softbody_msgs::Release::Request& request, softbody_msgs::Release::Response& response);

  const Simulator* simulator_;
  SurroundingsTracker* surroundings_;
  ros::Subscriber pin_subscriber_;
  ros::ServiceServer pin_, set_obstacle_, release_;
};

}  // namespace softbody
