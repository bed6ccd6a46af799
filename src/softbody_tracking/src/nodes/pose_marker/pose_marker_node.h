#pragma once

#include <geometry_msgs/Pose.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <string>

#include "nodes/pose_marker/pose_marker.h"
#include "softbody_common/ros/node_diagnostics.h"

namespace softbody {

/// Lets the user move a marker of the body in rviz and restart the tracking at its pose.
class PoseMarkerNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  PoseMarkerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);

 private:
  void onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message);
  void onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message);
  void onInfo(const sensor_msgs::CameraInfo::ConstPtr& message);
  std::string whyNotShown() const;
  void warnIfNotShown();
  void diagnose(NodeDiagnostics::Status& status) const;
  void restartTracking(const PoseMarker::Feedback& feedback);

  // Subscribers and timers come last, so that they are the first to be destroyed.
  std::string frame_;                 ///< of the marker; empty until the camera's is known
  geometry_msgs::Pose initial_pose_;  ///< of the last topology; zero: not given
  ros::ServiceClient set_pose_;
  PoseMarker marker_;
  ros::Subscriber volume_topology_subscriber_, surface_topology_subscriber_, info_subscriber_;
  ros::WallTimer warning_timer_;
  NodeDiagnostics diagnostics_;
};

}  // namespace softbody
