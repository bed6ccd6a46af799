#pragma once

#include <ros/ros.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <optional>
#include <string>

#include "nodes/cut_display.h"
#include "nodes/surface_editor.h"
#include "softbody_common/stage_timer.h"
#include "softbody_common/types.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// States of the volumetric model in, states of the visual mesh out; cuts of both. Parameters: ~object,
/// ~body_frame and those of CuttingConfig.
class SurfaceNode {
 public:
  /// @throw std::invalid_argument if a parameter or a file of the object cannot be used.
  SurfaceNode(ros::NodeHandle node, const ros::NodeHandle& private_node);

 private:
  /// The visual mesh bound to one topology of the volume.
  struct Binding {
    softbody_msgs::TetTopologyConstPtr volume;
    VisualSurface surface;
    softbody_msgs::MeshTopologyPtr topology;
  };

  /// An unknown body: its visual mesh is taken to be uncut.
  void startBody(const softbody_msgs::TetTopologyConstPtr& message);
  Binding bindingTo(const softbody_msgs::TetTopologyConstPtr& message) const;
  void adoptWaitingTopology();
  void onTopology(const softbody_msgs::TetTopologyConstPtr& message);
  void replaceBinding(Binding binding);
  void onState(const softbody_msgs::MeshStateConstPtr& message);
  void publishState(const softbody_msgs::MeshState& volume);
  void publishTiming(const std_msgs::Header& header);
  void publishTopology();

  std::string body_frame_;
  MeshTopology visual_;
  StageTimer timer_;
  CutDisplay cut_display_;
  std::optional<SurfaceEditor> editor_;                  ///< may be ahead of what is published
  std::optional<Binding> binding_;                       ///< that is published
  std::optional<Binding> next_binding_;                  ///< of an edit that no state has come of yet
  softbody_msgs::TetTopologyConstPtr waiting_topology_;  ///< its cut has not come yet
  softbody_msgs::MeshStateConstPtr waiting_state_;       ///< its topology has not come yet

  ros::Publisher topology_publisher_, state_publisher_, marker_publisher_, timing_publisher_;
  ros::Timer topology_timer_;
  ros::WallTimer late_timer_;  ///< ends the wait of waiting_topology_
  ros::Subscriber topology_subscriber_, state_subscriber_;
};

}  // namespace softbody
