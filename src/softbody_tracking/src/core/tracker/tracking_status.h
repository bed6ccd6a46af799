#pragma once

#include <set>
#include <string>
#include <vector>

#include "softbody_common/types.h"
#include "tracker/frame_observer.h"

namespace softbody {

/// How well a frame shows the body where it was predicted.
/// @param associations what was found to be a target.
TrackingStatus statusOf(const Observation& seen, const std::vector<Association>& associations);

/// Tells of the pieces of a cut body that nothing measures, once they have been held for some frames. A piece
/// that should show degrades the tracking. One that the prediction has out of view, or that is too small to
/// be followed, does not: where it is is inferred, like the rest of what is hidden.
class HeldPieces {
 public:
  /// @param names of each piece: its parts' numbers in the visual mesh. @param status is degraded, or its
  /// reason says too what is inferred.
  void tell(const Observation& seen, const std::vector<std::set<std::uint32_t>>& names,
            TrackingStatus* status);

  void reset() { frames_.clear(); }

 private:
  std::vector<int> frames_;  ///< of each piece: in which it hardly showed, on end
};

}  // namespace softbody
