#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "softbody_common/types.h"
#include "softbody_tracking/tool_mask.h"

namespace softbody {

/// A blade's outline in the frame that it was reported in.
struct ReportedBlade {
  Nanoseconds stamp;
  std::string frame_id;
  Points outline;  ///< #B by 3 [m]
};

/// Blades whose frames' places may come later than they do.
class BladeQueue {
 public:
  /// T_fixed_blade, empty where it is not known, or not yet.
  using Place = std::function<std::optional<Eigen::Isometry3d>(const ReportedBlade&)>;

  void add(ReportedBlade blade);
  void clear() { blades_.clear(); }

  /// Shows the mask the blade nearest in time to a frame of those that have a place. A frame that waits for
  /// the user's mask comes after later blades.
  /// @return how many became too old to count without ever having had a place; each is counted once.
  std::size_t show(Nanoseconds frame, const Place& place, ToolMask* mask);

 private:
  struct Waiting {
    ReportedBlade blade;
    std::optional<Points> placed;  ///< the outline in the fixed frame
  };
  std::deque<Waiting> blades_;
};

}  // namespace softbody
