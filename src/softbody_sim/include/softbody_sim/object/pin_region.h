#pragma once

#include <Eigen/Core>
#include <string>

namespace softbody {

/// Pinned vertices: those whose rest positions lie in a box.
struct PinRegion {
  std::string name;   ///< names the topic of the reaction force
  std::string frame;  ///< the pinned vertices move with this frame; empty: they stay where they are
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();  ///< [m]
};

}  // namespace softbody
