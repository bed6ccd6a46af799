#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "softbody_common/types.h"
#include "softbody_tracking/tool/tool_mask.h"

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

  /// What did not count, and should be told.
  struct Unused {
    std::size_t lost = 0;   ///< became too old without ever having had a place; each is counted once
    Nanoseconds ahead = 0;  ///< of the frame, the newest blade, once for a second all were too new; else 0
  };

  void add(ReportedBlade blade);
  void clear();

  /// Shows the mask the blade nearest in time to a frame of those that have a place. A frame that waits for
  /// the user's mask comes after later blades.
  Unused show(Nanoseconds frame, const Place& place, ToolMask* mask);

 private:
  Nanoseconds aheadOf(Nanoseconds frame);
  std::size_t forgetOld(Nanoseconds frame);

  struct Waiting {
    ReportedBlade blade;
    std::optional<Points> placed;  ///< the outline in the fixed frame
  };
  std::deque<Waiting> blades_;
  std::optional<Nanoseconds> ahead_since_;  ///< the first frame in a row that all are too new for
};

}  // namespace softbody
