#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>
#include <tf2_ros/transform_broadcaster.h>

#include <Eigen/Geometry>
#include <string>

#include "softbody_common/time/stage_timer.h"
#include "softbody_tracking/tracker/tracking_result.h"

namespace softbody {

/// Publishes what the tracker found in a frame.
class TrackingPublisher {
 public:
  /// @param body_frame child frame of the body's tf.
  TrackingPublisher(ros::NodeHandle handle, std::string body_frame);

  void publishStatus(const std_msgs::Header& camera_header, const TrackingStatus& status) const;
  /// Features, in the camera's frame. Nothing is computed without a subscriber.
  void publishFeatures(const std_msgs::Header& camera_header,
                       const std::vector<TrackedFeature>& features) const;
  /// What each pixel shows. Nothing is computed without a subscriber. @param size of the frame [px].
  void publishLabels(const std_msgs::Header& camera_header, const TrackingResult& result,
                     const cv::Size& size) const;
  /// @param fixed_header with the frame of the targets' positions.
  void publishTargets(const std_msgs::Header& fixed_header, const TargetSet& targets) const;
  void publishBodyPose(const std_msgs::Header& camera_header, const Eigen::Isometry3d& T_camera_body);
  void publishTiming(const std_msgs::Header& camera_header, const std::vector<StageTime>& stages) const;

 private:
  std::string body_frame_;
  image_transport::Publisher labels_;
  ros::Publisher features_, features_marker_, targets_, status_, timing_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;
};

}  // namespace softbody
