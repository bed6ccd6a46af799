#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "status/disagreement.h"
#include "tracker/observation.h"

namespace softbody {

/// How far a body may be from its prediction.
struct ShownError {
  Disagreement disagreement;  ///< mean of the last frames
  double bound_m = 0.0;       ///< see medianBound()
  double image_scale = 1.0;   ///< see imageScale()
};

/// How well the last frames show the body where it was predicted.
/// @param associations only those that become targets. @param tolerance_m largest error of a tracked body.
TrackingStatus statusOf(const Observation& seen, const std::vector<Association>& associations,
                        const ShownError& error, double tolerance_m);

/// Reports pieces of a cut body that were not measured for some time and are held in their places. A piece
/// in view degrades the tracking. A piece out of view, or too small to be tracked, does not: its place is
/// inferred, like that of all hidden parts.
class HeldPieces {
 public:
  /// Call once a frame. @param names for each piece, its numbers in the visual mesh. @param stamp of the
  /// frame.
  /// @return the status, degraded or with a longer reason.
  TrackingStatus report(const Observation& seen, const std::vector<std::set<std::uint32_t>>& names,
                        Nanoseconds stamp, TrackingStatus status);

  void reset() { since_.clear(); }

 private:
  std::vector<std::optional<Nanoseconds>> since_;  ///< per piece: stamp since which it is almost hidden
};

}  // namespace softbody
