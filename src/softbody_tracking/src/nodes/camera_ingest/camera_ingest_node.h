#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <optional>

#include "nodes/camera_ingest/camera_ingest_outputs.h"
#include "nodes/camera_ingest/camera_ingest_watch.h"
#include "softbody_common/parameters.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody {

/// Raw colour and registered depth in; rectified images and coloured points out.
class CameraIngestNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  CameraIngestNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);
  ~CameraIngestNode();

 private:
  using Pairer =
      FramePairer<sensor_msgs::ImageConstPtr, sensor_msgs::ImageConstPtr, sensor_msgs::CameraInfoConstPtr>;

  void subscribe(ros::NodeHandle handle, const ros::NodeHandle& private_handle, int queue_size);
  StreamTopics streamTopics() const;

  void onColor(const sensor_msgs::ImageConstPtr& image);
  void onDepth(const sensor_msgs::ImageConstPtr& image);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void processCompleteFrames();
  void process(const Pairer::Frame& frame);

  std::optional<CameraIngest> ingest_;
  std::optional<Pairer> pairer_;
  std::optional<CameraIngestOutputs> outputs_;
  std::optional<CameraIngestWatch> watch_;
  StageTimer timer_;
  std::optional<image_transport::ImageTransport> transport_;
  image_transport::Subscriber color_subscriber_, depth_subscriber_;
  ros::Subscriber info_subscriber_;
};

}  // namespace softbody
