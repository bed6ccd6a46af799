#pragma once

#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <future>
#include <optional>
#include <string>

#include "key_frames/key_frame_choice.h"
#include "motion/sheet_motion.h"
#include "nodes/clicked_object.h"
#include "softbody_scanning/ros/scanner_options.h"
#include "softbody_scanning/scan/scanned_body.h"

namespace softbody::scanning {

/// The surface so far, or why there is none.
struct Preview {
  std::optional<RegisteredSurface> surface;
  std::string problem;
};

/// Scans an object on a sheet of markers while the camera walks round it: publishes the growing surface, and
/// writes the model when it is told to finish.
class ScannerNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  ScannerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

 private:
  ScannerNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const ScannerOptions& options);

  void onFrame(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth,
               const sensor_msgs::CameraInfoConstPtr& info);
  void place(const std_msgs::Header& header, const Eigen::Isometry3d& T_camera_model);
  void showProgress();
  void show(const Preview& preview);
  void publish(const RegisteredSurface& surface);
  bool start(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool finish(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool discard(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  void dropViews();
  PosedRecording recording();
  std::string progressText() const;

  ToolDescription sheet_;
  std::string output_;
  SheetMotion motion_;
  KeyFrameChoice choice_;
  bool running_ = true;
  int frames_ = 0, posed_ = 0;
  double seen_ = 0.0;                          // share of the surface in the last preview
  std::string last_error_, object_, problem_;  // of the last frame; of the last preview
  std::future<Preview> preview_;
  ClickedObject clicked_;
  std::uint32_t revision_ = 0;

  ros::Publisher topology_, state_, progress_;
  tf2_ros::TransformBroadcaster transforms_;
  ros::ServiceServer start_, finish_, discard_;
  message_filters::Subscriber<sensor_msgs::Image> color_, depth_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> info_;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::Image, sensor_msgs::CameraInfo> images_;
  ros::WallTimer timer_;
};

}  // namespace softbody::scanning
