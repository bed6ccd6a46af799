#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The motion of connected pieces without forces. Vertices that go straight on would blow a turning piece up,
/// and lose its angular momentum. So a piece goes straight on and turns as a whole, and only the rest of its
/// velocity moves its vertices one by one.
class FreeMotion {
 public:
  /// @param masses #V [kg].
  FreeMotion(const TetTopology& topology, const Eigen::VectorXd& masses);

  /// Where the vertices are after a time [s]. @param velocity #V by 3 [m/s]. @param x #V by 3 [m].
  void advance(const Points& velocity, double time_s, Points* x) const;

  /// The velocities with which the vertices came from `before` to `after` in a time, so that a motion of
  /// advance() keeps its momentum and its angular momentum.
  void setVelocity(const Points& before, const Points& after, double time_s, Points* velocity) const;

 private:
  Eigen::Vector3d centerOf(const std::vector<int>& piece, const Points& x) const;
  Eigen::Matrix3d inertiaOf(const std::vector<int>& piece, const Points& x,
                            const Eigen::Vector3d& center) const;

  std::vector<std::vector<int>> pieces_;
  Eigen::VectorXd masses_;
};

}  // namespace softbody
