#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_recordings/ros/atomic_bag.h"

namespace softbody {

/// Writes a camera's topics into a bag (lz4, record time = header stamp). The file appears when finish() is
/// called; until then an earlier file stays unchanged.
class CameraBag {
 public:
  /// @param info without header. @throw std::runtime_error if the file cannot be written.
  CameraBag(const std::filesystem::path& output, sensor_msgs::CameraInfo info);

  /// Latched /tf_static camera_link -> camera_color_optical_frame (REP-103).
  void writeOpticalFrame(Nanoseconds stamp);
  void writeColor(Nanoseconds stamp, const cv::Mat3b& bgr);
  /// @param depth CV_16UC1 [mm] or CV_32FC1 [m].
  void writeDepth(Nanoseconds stamp, const cv::Mat& depth);
  void finish() { bag_.finish(); }

 private:
  void writeImage(const std::string& topics, Nanoseconds stamp, const cv::Mat& image, const char* encoding);

  sensor_msgs::CameraInfo info_;
  AtomicBag bag_;
};

}  // namespace softbody
