#pragma once

#include <string>

namespace softbody {

/// The camera_info beside an image topic: "/rgb/image_raw" has "/rgb/camera_info", as in all of ROS.
inline std::string infoTopicOf(const std::string& image) {
  return image.substr(0, image.rfind('/') + 1) + "camera_info";
}

/// The topics of a camera, and the unit of its depth. The default names are those of realsense2_camera in a
/// namespace, e.g. "/camera".
struct CameraTopics {
  CameraTopics(const std::string& camera)
      : color(camera + "/color/image_raw"),
        color_info(infoTopicOf(color)),
        depth(camera + "/aligned_depth_to_color/image_raw"),
        depth_info(infoTopicOf(depth)) {}
  CameraTopics(const char* camera) : CameraTopics(std::string(camera)) {}

  std::string color, color_info, depth, depth_info;
  double depth_scale = 0.0;  ///< metres per unit of depth; 0: 0.001 for 16UC1, 1 for 32FC1
};

/// Units of depth images that cameras and data sets use [m]: metre, centimetre, millimetre, half of it, and
/// those of RealSense L515 (0.25 mm), SR300 (0.125 mm), D405 (0.1 mm) and of the TUM data set (0.2 mm).
constexpr double kDepthUnits_m[] = {1.0, 0.01, 0.001, 0.0005, 0.00025, 0.0002, 0.000125, 0.0001};

}  // namespace softbody
