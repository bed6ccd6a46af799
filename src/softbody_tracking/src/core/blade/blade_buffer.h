#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/tool/tool_mask.h"

namespace softbody {

/// A blade's outline in the frame in which it was reported.
struct ReportedBlade {
  Nanoseconds stamp;
  std::string frame_id;
  Points outline;  ///< #B by 3 [m]
};

/// Keeps blades until tf gives the pose of their frames, and selects the blade that is nearest in time to a
/// frame.
class BladeBuffer {
 public:
  /// T_fixed_blade; empty if it is unknown or not known yet.
  using PoseLookup = std::function<std::optional<Eigen::Isometry3d>(const ReportedBlade&)>;

  /// Blades that could not be used.
  struct Rejected {
    std::size_t expired = 0;  ///< blades that became too old without a pose; each is counted once
    Nanoseconds lead = 0;     ///< newest blade minus frame, if all blades are too new for over 1 s; or 0
  };

  void add(ReportedBlade blade);
  void clear();

  /// Gives the mask the blade with a known pose that is nearest in time to the frame. Later blades may have
  /// come already, because a frame may wait for its segmentation mask.
  Rejected updateMask(Nanoseconds frame, const PoseLookup& look_up, ToolMask* mask);

 private:
  struct BufferedBlade {
    ReportedBlade blade;
    std::optional<Points> placed;  ///< the outline in the fixed frame
  };

  std::size_t removeExpired(Nanoseconds frame);
  Nanoseconds leadOver(Nanoseconds frame);

  std::deque<BufferedBlade> blades_;
  std::optional<Nanoseconds>
      lead_since_;  ///< the first of the consecutive frames for which all blades are too new
};

}  // namespace softbody
