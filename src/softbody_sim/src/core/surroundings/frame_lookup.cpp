#include "softbody_sim/surroundings/frame_lookup.h"

namespace softbody {

std::optional<StampedPose> findFrame(const FrameLookup& lookup, const std::string& frame, Nanoseconds stamp) {
  if (frame.empty()) return StampedPose{Eigen::Isometry3d::Identity(), stamp};
  return lookup(frame, stamp);
}

}  // namespace softbody
