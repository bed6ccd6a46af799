#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/surroundings/frame_lookup.h"
#include "softbody_sim/surroundings/lasting_fault.h"

namespace softbody {

/// The tf frame that a pin or an obstacle follows. Before tf knows the frame it has no pose. When tf has no
/// new pose, it stays at its last one: what a silent robot holds most likely stands still, too. Either state
/// is a fault once it lasts longer than a second.
class FollowedFrame {
 public:
  /// @param owner what follows, for log messages, like "pin 'grip'". @param frame empty: that of the targets.
  FollowedFrame(std::string owner, std::string frame) : owner_(std::move(owner)), frame_(std::move(frame)) {}

  /// Looks the pose up at a stamp.
  void update(const FrameLookup& lookup, Nanoseconds stamp, LogLines* log);

  /// tf does not know the frame when somebody names it: says so at once.
  void reportUnknown(LogLines* log);

  const std::string& frame() const { return frame_; }
  /// The last one known; empty: there was none yet.
  const std::optional<Eigen::Isometry3d>& pose() const { return pose_; }
  /// In a sentence; empty: none.
  const std::string& fault() const { return fault_.sentence(); }

 private:
  void report(double silence_s, LogLines* log);

  std::string owner_, frame_;
  std::optional<Eigen::Isometry3d> pose_;
  std::optional<Nanoseconds> seen_;  ///< stamp of the last pose, or of the first time that it was missing
  LastingFault fault_;
};

}  // namespace softbody
