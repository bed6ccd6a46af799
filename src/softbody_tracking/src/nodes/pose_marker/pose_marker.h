#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>
#include <softbody_msgs/MeshTopology.h>

#include <functional>
#include <string>

#include "softbody_common/ros/queued_calls.h"

namespace softbody {

/// The body as an interactive marker of rviz, with the menu entry "track from here".
class PoseMarker {
 public:
  using Feedback = visualization_msgs::InteractiveMarkerFeedback;
  /// Called in the handle's queue when the user picks the menu entry. The feedback holds the marker's pose.
  using Callback = std::function<void(const Feedback& feedback)>;

  PoseMarker(const ros::NodeHandle& handle, Callback on_track);

  /// Where the marker starts; moves a marker that is already shown.
  void setStartPose(const geometry_msgs::Pose& pose);

  /// Shows a mesh, at the start pose or at the pose of the mesh shown before. The same mesh changes nothing.
  /// @throw std::invalid_argument if the mesh is malformed.
  void show(const softbody_msgs::MeshTopology::ConstPtr& mesh, const std::string& frame);

  bool isShown() const { return mesh_ != nullptr; }

 private:
  using FeedbackPtr = visualization_msgs::InteractiveMarkerFeedbackConstPtr;

  void onFeedback(const Feedback& feedback);

  Callback on_track_;
  softbody_msgs::MeshTopology::ConstPtr mesh_;  ///< that is shown
  geometry_msgs::Pose start_pose_;
  geometry_msgs::PoseStamped pose_;  ///< of the marker that is shown; the last one that is usable
  QueuedCalls calls_;  ///< the server calls in the process's queue: in a nodelet, another thread's
  interactive_markers::MenuHandler menu_;
  interactive_markers::InteractiveMarkerServer server_;  ///< last: it calls the menu
};

}  // namespace softbody
