#pragma once

#include <Eigen/Geometry>
#include <string>

namespace softbody {

/// A pinned part of the body: what lies in a box.
struct PinRegion {
  std::string name;   ///< names the topic of the reaction force
  std::string frame;  ///< the pinned vertices move with this frame; empty: they stay where they are
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();  ///< [m]
  /// Where the box is. False: in rest space. True: in `frame`, at the moment when it takes hold (a gripper).
  bool in_frame = false;

  Eigen::AlignedBox3d box() const { return {min, max}; }
};

}  // namespace softbody
