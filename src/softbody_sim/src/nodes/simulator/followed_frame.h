#pragma once

#include <ros/time.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "nodes/frame_poses.h"
#include "nodes/simulator/lasting_fault.h"

namespace softbody {

/// The tf frame that a pin or an obstacle follows. Before tf knows the frame it has no pose. When tf has no
/// new pose, it stays at its last one: what a silent robot holds most likely stands still, too. Either state
/// is a fault once it lasts longer than a timeout.
class FollowedFrame {
 public:
  /// @param owner what follows, for log messages, like "pin 'grip'".
  FollowedFrame(std::string owner, std::string frame, double timeout_s)
      : owner_(std::move(owner)), frame_(std::move(frame)), timeout_s_(timeout_s) {}

  /// Looks the pose up at a stamp, in the target frame.
  void update(const FramePoses& poses, const std::string& target_frame, const ros::Time& stamp);

  /// tf does not know the frame when somebody names it: says so at once.
  void reportUnknown();

  /// The last one known; empty: there was none yet.
  const std::optional<Eigen::Isometry3d>& pose() const { return pose_; }
  /// In a sentence; empty: none.
  const std::string& fault() const { return fault_.sentence(); }

 private:
  void report(double silence_s);

  std::string owner_, frame_;
  double timeout_s_;
  std::optional<Eigen::Isometry3d> pose_;
  std::optional<double> seen_s_;  ///< stamp of the last pose, or of the first time that it was missing
  LastingFault fault_;
};

}  // namespace softbody
