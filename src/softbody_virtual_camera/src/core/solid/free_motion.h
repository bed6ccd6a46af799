#pragma once

#include <functional>
#include <vector>

#include "solid/hex_solid.h"

namespace softbody::virtual_camera {

/// A body that starts at rest and moves on its own.
struct FreeMotion {
  Eigen::VectorXd start;     ///< of all nodes, three numbers each; the held ones stay there [m]
  std::vector<bool> held;    ///< for each node
  double density = 0.0;      ///< [kg/m^3]
  Eigen::VectorXd loads;     ///< on the nodes [N]
  double damping_1_s = 0.0;  ///< share of the velocity that is lost per second, while it is small
};

/// The positions of the nodes at equal intervals, the start first. Leapfrog steps with lumped masses: they
/// are symplectic, so only the damping takes energy. A step is 0.7 of what is stable for the rest shape.
std::vector<Eigen::VectorXd> moveFreely(const HexSolid& solid, const FreeMotion& motion, double interval_s,
                                        int intervals);

}  // namespace softbody::virtual_camera
