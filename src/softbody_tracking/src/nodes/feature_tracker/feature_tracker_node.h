#pragma once

#include <ros/ros.h>
#include <softbody_msgs/SetPose.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nodes/feature_tracker/blade_subscriber.h"
#include "nodes/feature_tracker/body_subscriber.h"
#include "nodes/feature_tracker/known_subscriber.h"
#include "nodes/feature_tracker/mask_synchronizer.h"
#include "nodes/feature_tracker/robot_links.h"
#include "nodes/feature_tracker/tracking_publisher.h"
#include "nodes/frame_watchdog.h"
#include "nodes/output_frame.h"
#include "nodes/rectified_image_subscriber.h"
#include "nodes/throttled_log.h"
#include "softbody_common/ros/live_parameters.h"
#include "softbody_common/ros/node_diagnostics.h"
#include "softbody_common/ros/stamp_gate.h"
#include "softbody_tracking/ros/node_options.h"
#include "softbody_tracking/tracker/body_tracker.h"
#include "status/state_announcer.h"

namespace softbody {

/// Rectified images and the simulator's last state in; targets, features, labels, status and the body's tf
/// out.
class FeatureTrackerNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  FeatureTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

 private:
  FeatureTrackerNode(const ros::NodeHandle& handle, ros::NodeHandle private_handle,
                     const FeatureTrackerOptions& options);

  void readPicture(const ros::NodeHandle& private_handle);
  void onFrame(const RectifiedImages& images);
  bool onSetPose(softbody_msgs::SetPose::Request& request, softbody_msgs::SetPose::Response& response);
  bool onFindAgain(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  void track(const ReceivedFrame& received, const cv::Mat1b& mask);
  RgbdFrame withKnown(RgbdFrame frame, const std_msgs::Header& header);
  void forgetPass();
  std::optional<Eigen::Isometry3d> cameraPose(const std_msgs::Header& header);
  void publish(const std_msgs::Header& header, const cv::Size& image, const TrackingResult& result);
  void report(const std_msgs::Header& header, const TrackingStatus& status);
  void reportSilence();
  void diagnose(NodeDiagnostics::Status& status) const;

  // Subscribers, services and timers come last, so that they are the first to be destroyed.
  FeatureTrackerOptions options_;
  OutputFrame output_frame_;
  BodyTracker tracker_;
  TrackingPublisher publisher_;
  TrackingStatus last_status_;
  std_msgs::Header last_header_;  ///< of the last frame with a status; empty before the first
  StateAnnouncer announcer_;
  std::string camera_frame_;  ///< of the last frame; empty before the first
  StampGate stamps_;          ///< of the frames
  FrameWatchdog watchdog_;
  ros::SteadyTime last_publisher_ = ros::SteadyTime::now();  ///< when somebody sent images, or the start
  ThrottledLog log_;

  BodySubscriber body_;
  BladeSubscriber blade_;
  std::vector<std::unique_ptr<KnownSubscriber>> known_;
  std::unique_ptr<RobotLinks> robot_;  ///< nullptr: no robot
  ros::ServiceServer set_pose_;
  ros::ServiceServer find_again_;
  std::unique_ptr<MaskSynchronizer> mask_synchronizer_;  ///< nullptr: no masks are used
  RectifiedImageSubscriber images_;
  ros::WallTimer silence_timer_;
  NodeDiagnostics diagnostics_;
  LiveParameters live_parameters_;
};

}  // namespace softbody
