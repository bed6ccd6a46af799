#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <optional>

#include "softbody_common/time/stage_timer.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// A frame, and the messages that hold its images.
struct IngestedFrame {
  RgbdFrame frame;                           ///< its depth is in the message; colour may be empty
  sensor_msgs::ImageConstPtr color_message;  ///< of the driver; null: the frame's colour is another image
  sensor_msgs::ImagePtr depth_message;
};

/// A 32FC1 image of a camera, to write depth into.
sensor_msgs::ImagePtr blankDepth(const Pinhole& camera, const std_msgs::Header& header);
/// The memory of such a message.
cv::Mat1f depthIn(sensor_msgs::Image* image);

/// The topics of camera_ingest: rectified colour and depth, their camera_info, points and stage times.
class CameraIngestOutputs {
 public:
  /// @param voxel_size_m of the points; 0: organised, one point a pixel.
  /// An image that was missing may complete several frames at once, of which none may be lost: subscribers
  /// choose for themselves whether they want the newest alone.
  CameraIngestOutputs(ros::NodeHandle handle, double voxel_size_m);

  void setVoxelSize(double voxel_size_m) { voxel_size_m_ = voxel_size_m; }

  bool hasSubscriber() const;
  /// Whether points are published, which need the frame's colour.
  bool hasPointSubscriber() const;

  /// Publishes what has a subscriber, and the timer's rows with it.
  void publish(const IngestedFrame& ingested, const std_msgs::Header& header, StageTimer* timer);

 private:
  void publishPoints(const RgbdFrame& frame, const std_msgs::Header& header) const;
  /// Few points and seldom: enough to look at, and little to draw.
  void publishPointsMarker(const RgbdFrame& frame, const std_msgs::Header& header);

  double voxel_size_m_;
  std::optional<std::int64_t> last_marker_;  ///< stamp [ns]
  image_transport::Publisher color_, depth_;
  ros::Publisher info_, depth_info_, points_, points_marker_, timing_;
};

}  // namespace softbody
