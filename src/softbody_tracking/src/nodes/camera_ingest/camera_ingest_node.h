#pragma once

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <optional>
#include <string>

#include "nodes/camera_ingest/camera_ingest_outputs.h"
#include "nodes/camera_ingest/camera_ingest_watch.h"
#include "nodes/camera_ingest/image_input.h"
#include "softbody_common/ros/live_parameters.h"
#include "softbody_common/ros/transform_input.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/camera/frame_pairer.h"
#include "softbody_tracking/ros/camera_reader.h"
#include "softbody_tracking/ros/node_options.h"

namespace softbody {

/// Raw colour and depth in; rectified images and coloured points out.
class CameraIngestNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  CameraIngestNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~CameraIngestNode();

 private:
  using Pairer =
      FramePairer<sensor_msgs::ImageConstPtr, sensor_msgs::ImageConstPtr, sensor_msgs::CameraInfoConstPtr>;

  void subscribe(ros::NodeHandle handle);
  StreamTopics streamTopics() const;

  void onColor(const sensor_msgs::ImageConstPtr& image);
  void onDepth(const sensor_msgs::ImageConstPtr& image);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void processCompleteFrames();
  void process(const Pairer::Frame& images);
  IngestedFrame ingest(const Pairer::Frame& images, const std_msgs::Header& header);
  Eigen::Isometry3d newestTransform(const std::string& target, const std::string& source);

  CameraIngestOptions options_;
  std::optional<CameraReader> reader_;
  std::optional<CameraIngest> ingest_;
  std::optional<Pairer> pairer_;
  std::optional<CameraIngestOutputs> outputs_;
  std::optional<CameraIngestWatch> watch_;
  StageTimer timer_;
  std::optional<TransformInput> transforms_;  ///< only if depth has its own frame
  sensor_msgs::CameraInfoConstPtr depth_info_;
  std::optional<ImageInput> color_, depth_;
  ros::Subscriber color_info_, depth_info_subscriber_;
  std::optional<LiveParameters> live_parameters_;
};

}  // namespace softbody
