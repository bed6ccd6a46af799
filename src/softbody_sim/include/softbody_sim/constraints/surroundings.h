#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"
#include "softbody_sim/constraints/obstacle.h"

namespace softbody {

/// A vertex held at a position, in the frame of the targets.
struct Pin {
  int vertex = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
};

/// What acts on the body besides targets and gravity.
struct Surroundings {
  std::vector<Pin> pins;
  std::vector<Obstacle> obstacles;  ///< in the same order at every step
  Points loads;                     ///< #V by 3 forces [N], or empty
};

/// What the body does to a pin or an obstacle, in the targets' frame.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< about the pin, or the obstacle's origin [N m]
};

/// The body's forces on its surroundings at the end of a step.
struct Reactions {
  std::vector<Wrench> pins;
  std::vector<Wrench> obstacles;
};

/// @throw std::invalid_argument if a pin names a vertex that does not exist, or a number is not finite.
void requireUsable(const Surroundings& surroundings, Eigen::Index vertex_count);

}  // namespace softbody
