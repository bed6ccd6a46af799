#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/obstacle.h"

namespace softbody {

/// A vertex held at a position, in the frame of the targets. The position is a measurement: the body goes to
/// the mean of what pins and targets say, weighted by their inverse variances.
struct Pin {
  int vertex = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double accuracy_m = 0.0;  ///< standard deviation of the position; 0: as stiff as the solver allows
};

/// What acts on the body besides targets and gravity.
struct Surroundings {
  std::vector<Pin> pins;
  std::vector<Obstacle> obstacles;  ///< in the same order at every step
  /// Obstacles came or went since the last step. Then no obstacle pushes what lies between its last pose and
  /// the present one.
  bool obstacles_changed = false;
  Points loads;  ///< #V by 3 forces [N], or empty
};

/// What the body does to a pin or an obstacle, in the targets' frame.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< about the pin, or the obstacle's origin [N m]
};

/// The body's forces on its surroundings at the end of a step: elasticity, inertia, gravity and contact. The
/// springs of targets are measurements. They do not count.
struct Reactions {
  std::vector<Wrench> pins;
  std::vector<Wrench> obstacles;
};

/// @throw std::invalid_argument if a pin names a vertex that does not exist, a number is not finite, or an
/// accuracy is negative.
void requireUsable(const Surroundings& surroundings, Eigen::Index vertex_count);

}  // namespace softbody
