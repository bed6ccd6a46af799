#pragma once

#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <string>

namespace softbody {

/// The body as an interactive marker of rviz: whoever moves it where the body is, and picks "track from here"
/// in its menu, starts tracking anew there.
class PoseMarkerNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  PoseMarkerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);

 private:
  void onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message);
  void onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message);
  void onInfo(const sensor_msgs::CameraInfo::ConstPtr& message);
  void watch();
  void track(const visualization_msgs::InteractiveMarkerFeedback& feedback);

  std::string frame_;                           ///< empty until the camera's is known
  softbody_msgs::MeshTopology::ConstPtr mesh_;  ///< that is shown
  geometry_msgs::Pose start_;                   ///< where it stands first
  interactive_markers::InteractiveMarkerServer server_;
  interactive_markers::MenuHandler menu_;
  ros::ServiceClient set_pose_;
  ros::Subscriber volume_topology_subscriber_, surface_topology_subscriber_, info_subscriber_;
  ros::WallTimer watch_timer_;
};

}  // namespace softbody
