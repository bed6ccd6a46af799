#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <deque>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The blade of a tracked tool and its recent path, as markers for rviz.
class BladeTrail {
 public:
  /// @param blade polygon in the tool frame [m].
  explicit BladeTrail(Points blade) : blade_(std::move(blade)) {}

  /// Adds a pose of the tool. A gap in time, or an older stamp, starts a new trail.
  void add(Nanoseconds stamp, const Eigen::Isometry3d& T_fixed_tool);

  /// The markers "blade", its present outline, and "trail", its earlier outlines and its corners' paths,
  /// which fade.
  /// @param header with the stamp of the last pose and the fixed frame's id.
  visualization_msgs::MarkerArray markers(const std_msgs::Header& header) const;

 private:
  struct Outline {
    Nanoseconds stamp;
    Points corners;
  };
  float freshness(const Outline& outline) const;

  Points blade_;
  std::deque<Outline> outlines_;  ///< the newest is the last
};

}  // namespace softbody
