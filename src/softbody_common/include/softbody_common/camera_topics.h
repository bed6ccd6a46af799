#pragma once

#include <string>

namespace softbody {

/// The topics of a camera in a namespace, e.g. "/camera".
struct CameraTopics {
  explicit CameraTopics(const std::string& camera)
      : color(camera + "/color/image_raw"),
        color_info(camera + "/color/camera_info"),
        depth(camera + "/aligned_depth_to_color/image_raw"),
        depth_info(camera + "/aligned_depth_to_color/camera_info") {}
  std::string color, color_info, depth, depth_info;
};

}  // namespace softbody
