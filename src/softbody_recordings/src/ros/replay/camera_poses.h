#pragma once

#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "softbody_recordings/ros/bag_transforms.h"

namespace softbody {

/// The camera's poses in the output frame, from a bag's tf.
class CameraPoses {
 public:
  /// @param output_frame if empty, the camera's frame.
  CameraPoses(const std::string& bag, const std::string& output_frame);

  /// @throw tf2::TransformException if the bag has no pose for this stamp.
  Eigen::Isometry3d of(const std_msgs::Header& header) const;

  const std::string& outputFrame() const { return output_frame_; }
  std::vector<std::string> warnings() const;

 private:
  std::string output_frame_;
  std::optional<BagTransforms> transforms_;
};

}  // namespace softbody
