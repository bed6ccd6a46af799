#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <deque>

#include "softbody_common/types.h"

namespace softbody {

/// The blade of a tracked tool and the way that it came, as markers for rviz.
class BladeTrail {
 public:
  /// @param blade polygon in the tool frame [m].
  explicit BladeTrail(Points blade) : blade_(std::move(blade)) {}

  /// The tool is seen. A gap, or time that jumps back, begins a new trail.
  void add(Nanoseconds stamp, const Eigen::Isometry3d& T_fixed_tool);

  /// "blade", its outline now, and "trail", its earlier outlines and the paths of its corners, which fade.
  /// @param header with the stamp of the frame and the id of the fixed frame.
  visualization_msgs::MarkerArray markers(const std_msgs::Header& header) const;

 private:
  struct Outline {
    Nanoseconds stamp;
    Points corners;
  };
  float freshness(const Outline& outline) const;

  Points blade_;
  std::deque<Outline> outlines_;  ///< the newest at the back
};

}  // namespace softbody
