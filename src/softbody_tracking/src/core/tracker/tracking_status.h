#pragma once

#include <set>
#include <string>
#include <vector>

#include "softbody_common/types.h"
#include "tracker/observation.h"

namespace softbody {

/// How well a frame shows the body where it was predicted. @param associations only those that become
/// targets.
TrackingStatus statusOf(const Observation& seen, const std::vector<Association>& associations);

/// Reports pieces of a cut body that were not measured for some frames and are held in their places. A piece
/// in view degrades the tracking. A piece out of view, or too small to be tracked, does not: its place is
/// inferred, like that of all hidden parts.
class HeldPieces {
 public:
  /// Call once a frame. @param names for each piece, its numbers in the visual mesh.
  /// @return the status, degraded or with a longer reason.
  TrackingStatus report(const Observation& seen, const std::vector<std::set<std::uint32_t>>& names,
                        TrackingStatus status);

  void reset() { frames_.clear(); }

 private:
  std::vector<int> frames_;  ///< per piece: consecutive frames with poor observability
};

}  // namespace softbody
