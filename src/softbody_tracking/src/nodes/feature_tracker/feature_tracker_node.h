#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PolygonStamped.h>
#include <ros/ros.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/SetPose.h>
#include <softbody_msgs/TetTopology.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <optional>
#include <string>

#include "nodes/feature_tracker/mask_input.h"
#include "nodes/output_frame.h"
#include "nodes/rectified_input.h"
#include "softbody_common/parameters.h"
#include "softbody_tracking/tool/tool_mask.h"
#include "softbody_tracking/tracker/body_tracker.h"
#include "tool/blade_queue.h"

namespace softbody {

/// Rectified images and the simulator's last state in; targets, features, status and the body's tf out.
class FeatureTrackerNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  FeatureTrackerNode(const ros::NodeHandle& handle, ros::NodeHandle private_handle);

 private:
  void onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message);
  void onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message);
  void onBlade(const geometry_msgs::PolygonStamped::ConstPtr& message);
  void onVolumeState(const softbody_msgs::MeshState::ConstPtr& message);
  void onFrame(const RectifiedImages& images);
  void track(const RectifiedImages& images, const cv::Mat1b& mask);
  bool onSetPose(softbody_msgs::SetPose::Request& request, softbody_msgs::SetPose::Response& response);

  void adoptTopologies();
  void placeBlade(const ros::Time& stamp);
  void skip(const std_msgs::Header& header, const std::string& why);
  /// @throw tf2::TransformException.
  Eigen::Isometry3d fixedPose(const std_msgs::Header& header, double patience_s) const;
  std::optional<MeshState> volume() const;
  void publishStatus(const std_msgs::Header& header);
  void publish(const std_msgs::Header& camera_header, const Eigen::Isometry3d& T_output_camera,
               const TrackingResult& result);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  ros::NodeHandle handle_;
  std::string body_frame_;
  std::unique_ptr<OutputFrame> output_frame_;
  std::string camera_frame_;  ///< of the last frame, empty before the first
  std::unique_ptr<BodyTracker> tracker_;
  std::unique_ptr<MaskInput> mask_input_;                           ///< only where masks are used
  std::optional<TetTopology> volume_topology_;                      ///< the newest
  std::optional<MeshTopology> surface_topology_;                    ///< the newest
  std::uint32_t adopted_revision_ = 0;                              ///< that the tracker works with
  softbody_msgs::MeshState::ConstPtr newest_state_, volume_state_;  ///< of any, and of the adopted revision
  BladeQueue blades_;                                               ///< not placed by tf yet
  ToolMask tool_mask_;
  TrackingStatus last_status_;
  ros::Time last_stamp_, last_arrival_;  ///< of the last frame

  tf2_ros::TransformBroadcaster tf_broadcaster_;
  ros::Publisher features_, features_marker_, targets_, status_, timing_;
  ros::ServiceServer set_pose_;
  ros::Subscriber volume_topology_subscriber_, surface_topology_subscriber_, volume_state_subscriber_,
      blade_subscriber_;
  std::optional<RectifiedInput> images_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace softbody
