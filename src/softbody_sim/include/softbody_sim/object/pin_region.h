#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Pinned vertices: those that lie in a box.
struct PinRegion {
  std::string name;   ///< names the topic of the reaction force
  std::string frame;  ///< the pinned vertices move with this frame; empty: they stay where they are
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();  ///< [m]
  /// Where the box is. False: in rest space. True: in `frame`, at the moment when it takes hold (a gripper).
  bool in_frame = false;
};

/// The points in a region's box, ascending. @param points #V by 3 [m]. @param T_box_points from their frame
/// to that of the box.
std::vector<int> verticesIn(const PinRegion& region, const Eigen::Isometry3d& T_box_points,
                            const Points& points);

}  // namespace softbody
