#pragma once

#include <ros/time.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <string>

#include "softbody_common/ros/transform_input.h"
#include "softbody_tracking/ros/node_options.h"

namespace softbody {

/// The fixed frame of bodies and tools: the parameter `output_frame`, or the camera's own frame if that is
/// empty.
class OutputFrame {
 public:
  explicit OutputFrame(const OutputFrameOptions& options);

  /// The parameter; empty: the camera's own frame.
  const std::string& name() const { return name_; }

  /// Warns when another node sends the transform of this node's frame. Call it once.
  /// @return the frame.
  const std::string& claim(const std::string& frame) {
    transforms_.claim(frame);
    return frame;
  }

  /// How long a pose is waited for [s]: `tf_timeout_s`.
  double timeout_s() const { return timeout_s_; }

  /// The camera's header with the fixed frame as its frame_id.
  std_msgs::Header fixedHeader(const std_msgs::Header& camera_header) const;

  /// T_fixed_camera at the header's stamp. @throw tf2::TransformException if tf does not know it in time, or
  /// the transform is not usable.
  Eigen::Isometry3d cameraPose(const std_msgs::Header& camera_header) const;

  /// T_fixed_frame of any frame at the header's stamp. @param header an empty frame_id means the camera's
  /// frame.
  /// @throw tf2::TransformException if tf does not know it within timeout_s.
  Eigen::Isometry3d poseOf(const std_msgs::Header& header, const std::string& camera_frame,
                           double timeout_s) const;

  /// The same without waiting. If tf does not know it yet, it is the newest one that tf knows.
  /// @throw tf2::TransformException if this is more than longest_age_s older than the stamp.
  Eigen::Isometry3d newestPoseOf(const std_msgs::Header& header, const std::string& camera_frame,
                                 double longest_age_s) const;

 private:
  Eigen::Isometry3d lookUp(const std::string& target, const std_msgs::Header& source, double timeout_s) const;

  std::string name_;
  double timeout_s_;
  TransformInput transforms_;
};

}  // namespace softbody
