#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace softbody {

/// Poses of frames from tf.
class FramePoses {
 public:
  struct StampedPose {
    Eigen::Isometry3d pose;
    ros::Time stamp;  ///< the stamp that was asked for, or of the last pose that tf has
  };

  FramePoses() : listener_(buffer_) {}
  FramePoses(const FramePoses&) = delete;
  FramePoses& operator=(const FramePoses&) = delete;

  /// Pose of a frame at a stamp, or its last pose if tf has none at the stamp. Empty if tf does not know the
  /// frame. An empty name is the target frame.
  std::optional<StampedPose> find(const std::string& frame, const std::string& target_frame,
                                  const ros::Time& stamp) const;

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace softbody
