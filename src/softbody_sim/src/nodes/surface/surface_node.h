#pragma once

#include <ros/ros.h>
#include <softbody_msgs/CutHistory.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/TetTopology.h>

#include <optional>
#include <string>

#include "nodes/object_visual.h"
#include "nodes/surface/bound_surface.h"
#include "nodes/surface/cut_display.h"
#include "nodes/surface/cut_services.h"
#include "nodes/surface/surface_diagnostics.h"
#include "nodes/surface/surface_editor.h"
#include "nodes/surface/surface_publisher.h"
#include "nodes/surface/surface_queries.h"
#include "softbody_common/geometry/types.h"
#include "softbody_common/ros/live_parameters.h"
#include "softbody_common/ros/stamp_gate.h"
#include "softbody_common/time/stage_timer.h"
#include "softbody_sim/ros/surface_options.h"

namespace softbody {

/// Subscribes to states and edits of the volumetric model; publishes states of the visual mesh; decides on
/// cuts; answers questions about the surface. Parameters: surfaceNodeParameters().
class SurfaceNode {
 public:
  /// @throw std::invalid_argument if a parameter or a file of the object cannot be used.
  SurfaceNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

 private:
  SurfaceNode(ros::NodeHandle node, const ros::NodeHandle& private_node, const SurfaceOptions& options);

  void onTopology(const softbody_msgs::TetTopologyConstPtr& message);
  void onVolumeEdits(const softbody_msgs::CutHistoryConstPtr& message);
  void onState(const softbody_msgs::MeshStateConstPtr& message);

  bool updateStamp(const softbody_msgs::TetTopology& message);
  void refuse(const softbody_msgs::TetTopology& message, const std::exception& error);
  void useWaiting(bool is_late);
  bool bindWaiting(bool is_late);
  void startBody(const softbody_msgs::TetTopology& message);
  void setBinding(BoundSurface binding);
  void useState(const softbody_msgs::MeshStateConstPtr& message);
  void publishState(const softbody_msgs::MeshState& volume);

  SurfaceOptions options_;
  ObjectVisual visual_;
  StampGate stamps_;  ///< of the volume's states
  StageTimer timer_;
  SurfacePublisher publisher_;
  CutDisplay cut_display_;
  std::optional<BoundSurface> binding_;                  ///< published
  std::optional<BoundSurface> next_binding_;             ///< of an edit that no state has come for yet
  softbody_msgs::TetTopologyConstPtr waiting_topology_;  ///< the edits that explain it have not come yet
  softbody_msgs::MeshStateConstPtr waiting_state_;       ///< its topology has not come yet
  // Last, so that callbacks end before the members that they use.
  SurfaceEditor editor_;  ///< may be ahead of what is published
  CutServices services_;
  SurfaceQueries queries_;
  SurfaceDiagnostics diagnostics_;
  LiveParameters live_parameters_;
  ros::WallTimer edits_timeout_;  ///< ends the wait of waiting_topology_
  ros::Subscriber topology_subscriber_, edits_subscriber_, state_subscriber_;
};

}  // namespace softbody
