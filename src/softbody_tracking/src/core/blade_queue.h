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

  /// Shows the mask the newest blade that has a place. Those after it wait for the next frame, until they are
  /// too old to count.
  /// @return how many became so without ever having had a place; each is counted once.
  std::size_t show(Nanoseconds frame, const Place& place, ToolMask* mask);

 private:
  std::deque<ReportedBlade> blades_;  ///< the newest last
};

}  // namespace softbody
