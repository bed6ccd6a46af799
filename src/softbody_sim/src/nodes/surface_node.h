#pragma once

#include <ros/ros.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <optional>
#include <string>

#include "softbody_common/stage_timer.h"
#include "softbody_common/types.h"
#include "softbody_sim/visual_surface.h"

namespace softbody {

/// States of the volumetric model in, states of the visual mesh out. Parameters: ~object, ~body_frame.
class SurfaceNode {
 public:
  /// @throw std::invalid_argument if a parameter or a file of the object cannot be used.
  SurfaceNode(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  void onTopology(const softbody_msgs::TetTopologyConstPtr& message);
  void bind(const softbody_msgs::TetTopology& message);
  void onState(const softbody_msgs::MeshStateConstPtr& message);
  void publishState(const softbody_msgs::MeshState& volume);
  void publishTiming(const std_msgs::Header& header);
  void publishTopology();

  std::string body_frame_;
  MeshTopology visual_;
  StageTimer timer_;
  softbody_msgs::TetTopologyConstPtr volume_topology_;  ///< that the surface is bound to
  softbody_msgs::MeshStateConstPtr waiting_state_;      ///< its topology has not come yet
  std::optional<VisualSurface> surface_;
  softbody_msgs::MeshTopologyPtr topology_message_;

  ros::Publisher topology_publisher_, state_publisher_, marker_publisher_, timing_publisher_;
  ros::Timer topology_timer_;
  ros::Subscriber topology_subscriber_, state_subscriber_;
};

}  // namespace softbody
