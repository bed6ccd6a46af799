#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/blade_trail.h"
#include "softbody_common/time/stage_timer.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// Publishes the tool's pose, its blade and its tf.
class ToolPublisher {
 public:
  /// @param blade polygon in the tool frame [m]; empty: no blade is published. @param tool_frame child of the
  /// tf.
  ToolPublisher(ros::NodeHandle handle, const Points& blade, std::string tool_frame);

  void publishPose(const std_msgs::Header& camera_header, const ToolObservation& observation);
  /// The blade in the camera's frame; nothing for a tool without a blade.
  void publishBlade(const std_msgs::Header& camera_header, const Eigen::Isometry3d& T_camera_tool) const;
  /// Extends the trail in the fixed frame, and publishes its markers if anyone subscribes.
  void publishTrail(const std_msgs::Header& fixed_header, const Eigen::Isometry3d& T_fixed_tool);
  void publishTiming(const std_msgs::Header& camera_header, const std::vector<StageTime>& stages) const;

 private:
  std::string tool_frame_;
  Points blade_;
  std::optional<BladeTrail> trail_;  ///< of a tool with a blade
  ros::Publisher pose_publisher_, blade_publisher_, marker_publisher_, timing_publisher_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;
};

}  // namespace softbody
