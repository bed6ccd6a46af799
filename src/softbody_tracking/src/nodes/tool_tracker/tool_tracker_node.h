#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>

#include "nodes/frame_watchdog.h"
#include "nodes/output_frame.h"
#include "nodes/rectified_image_subscriber.h"
#include "nodes/tool_tracker/tool_publisher.h"
#include "softbody_common/ros/node_diagnostics.h"
#include "softbody_common/ros/stamp_gate.h"
#include "softbody_tracking/ros/node_options.h"
#include "softbody_tracking/tool/tool_dropout_monitor.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody {

/// Rectified images in; the tool's pose with covariance, its blade and its tf out. A tool with a frame is
/// not looked for in the images: its pose comes from tf, at the stamp of each image.
class ToolTrackerNode {
 public:
  /// @throw std::invalid_argument for a bad parameter or tool YAML.
  ToolTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

 private:
  ToolTrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                  const ToolTrackerOptions& options);

  void onFrame(const RectifiedImages& images);
  void placeCamera(const std_msgs::Header& header, RgbdFrame* frame);
  std::optional<Eigen::Isometry3d> placeOfTool(const std_msgs::Header& header, const RgbdFrame& frame);
  void publish(const std_msgs::Header& header, const RgbdFrame& frame);
  void diagnose(NodeDiagnostics::Status& status) const;
  void diagnoseObservation(NodeDiagnostics::Status& status) const;

  // Subscribers and timers come last, so that they are the first to be destroyed.
  OutputFrame output_frame_;
  ToolTracker tracker_;
  ToolPublisher publisher_;
  ToolDropoutMonitor dropouts_;
  StampGate stamps_;                     ///< of the frames
  std::optional<ToolObservation> last_;  ///< of the last frame
  std::string frame_error_;              ///< why the last frame could not be used; empty: it could
  std::string tf_error_;       ///< why tf gave no pose of the camera for the last frame; empty: it did
  std::string tool_tf_error_;  ///< likewise of the tool's frame
  FrameWatchdog watchdog_;

  RectifiedImageSubscriber images_;
  NodeDiagnostics diagnostics_;
};

}  // namespace softbody
