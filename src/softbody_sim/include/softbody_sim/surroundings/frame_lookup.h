#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Pose of a frame in the frame of the targets.
struct StampedPose {
  Eigen::Isometry3d pose;
  Nanoseconds stamp = 0;  ///< the stamp that was asked for, or of the last pose that is known
};

/// Pose of a frame at a stamp. Empty: the frame has none. The name is not empty.
using FrameLookup = std::function<std::optional<StampedPose>(const std::string& frame, Nanoseconds stamp)>;

/// The same, where an empty name is the frame of the targets.
inline std::optional<StampedPose> findFrame(const FrameLookup& lookup, const std::string& frame,
                                            Nanoseconds stamp) {
  return frame.empty() ? StampedPose{Eigen::Isometry3d::Identity(), stamp} : lookup(frame, stamp);
}

}  // namespace softbody
