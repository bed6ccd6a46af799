#pragma once

#include <optional>
#include <vector>

#include "cutting/blade/tear_marks.h"

namespace softbody {

/// How the marks on one side of a tear have moved: an affine map.
struct SideMotion {
  Eigen::Vector3d rest, measured;  ///< centre of the marks [m]
  Eigen::Matrix3d linear;          ///< where the marks do not tell, that of their rotation
  double median_m = 0.0;           ///< distance of the marks from the map
  double rms_m = 0.0;              ///< the same, root mean square, for the freedom of the map
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< inverse scatter of the marks [1/m^2]

  Eigen::Vector3d at(const Eigen::Vector3d& point) const { return measured + linear * (point - rest); }
  /// Of a mark at this point from the map [m^2].
  double varianceAt(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d arm = point - rest;
    return rms_m * rms_m * (1.0 + arm.dot(spread * arm));
  }
};

/// The motions of both sides; empty with fewer than twenty marks on a side. A weighted least-squares fit with
/// Cauchy weights.
struct SideMotions {
  SideMotion above, below;
  /// How far the sides have parted at a point of the tear, in standard deviations.
  double partingAt(const Eigen::Vector3d& point) const;
};
std::optional<SideMotions> sideMotions(const std::vector<TearMark>& marks);

/// Gives every mark within the reach of the zone's plane to the side with which it has moved, by five
/// standard deviations. Marks that have moved with neither side, or with both, have none.
void takeSides(const TearZone& zone, std::vector<TearMark>* marks);

}  // namespace softbody
