#pragma once

#include <ros/time.h>
#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <string>

#include "softbody_common/parameters.h"

namespace softbody {

/// The frame that stands still, in which bodies and tools are followed, and where tf says that others are in
/// it.
class OutputFrame {
 public:
  /// Reads `output_frame` and `tf_timeout_s`. @throw std::invalid_argument as Parameters does.
  explicit OutputFrame(Parameters& parameters);

  /// Empty: the camera's own frame.
  const std::string& name() const { return name_; }
  /// A header's frame in this one at its stamp; identity where this one is the camera's own.
  /// @throw tf2::TransformException where tf does not tell it in time.
  Eigen::Isometry3d poseOf(const std_msgs::Header& header) const;
  /// T_target_source. @throw tf2::TransformException where tf does not know it within the patience.
  Eigen::Isometry3d lookUp(const std::string& target, const std::string& source, const ros::Time& stamp,
                           double patience_s) const;

 private:
  std::string name_;
  double timeout_s_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace softbody
