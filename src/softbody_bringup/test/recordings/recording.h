#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/protocol/camera_topics.h"

namespace softbody::recordings {

/// One frame of a recording. A lost message is nothing.
struct Frame {
  std::optional<sensor_msgs::Image> color, depth;
  std::optional<sensor_msgs::CameraInfo> color_info, depth_info;
  softbody_msgs::MeshState truth;
  ros::Time received;
};

/// A recording in memory, to be changed.
struct Recording {
  std::vector<Frame> frames;
  softbody_msgs::MeshTopology topology;
  tf2_msgs::TFMessage tf_static;
  CameraTopics topics = "/camera";   ///< under which it is recorded
  CameraTopics options = "/camera";  ///< which the tools get
  std::function<sensor_msgs::CompressedImage(const sensor_msgs::Image&)> compress_color, compress_depth;
  std::string md5sum;         ///< of the depth images' definition; empty: the right one
  std::size_t cut_bytes = 0;  ///< of the file's end
};

/// The first frames of a bag of the virtual camera.
Recording readRecording(const std::string& bag, std::size_t frames);

void writeRecording(const Recording& recording, const std::string& bag);

}  // namespace softbody::recordings
