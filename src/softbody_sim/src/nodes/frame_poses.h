#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>

#include "softbody_common/ros/transform_input.h"
#include "softbody_sim/surroundings/frame_lookup.h"

namespace softbody {

/// Poses of frames from tf.
class FramePoses {
 public:
  /// Pose of a frame at a stamp, or its last pose if tf has none at the stamp. Empty if tf does not know the
  /// frame. An empty name is the target frame.
  std::optional<StampedPose> find(const std::string& frame, const std::string& target_frame,
                                  const ros::Time& stamp) const;

  /// Whether tf has a pose of a frame. An empty name is the target frame.
  /// @param target_frame empty: not known yet; then any pose of the frame counts.
  bool knows(const std::string& frame, const std::string& target_frame) const;

 private:
  TransformInput transforms_;
};

}  // namespace softbody
