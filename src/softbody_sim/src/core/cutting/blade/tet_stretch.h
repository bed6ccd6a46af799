#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The largest principal stretch of a tet.
struct TetStretch {
  double stretch = 1.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< of the stretched material at rest, unit
  double deviation = 0.0;                                ///< standard deviation of the stretch

  /// The stretch that the tet has at least, however its vertices err: five standard deviations below.
  double least() const { return stretch - 5.0 * deviation; }
};

/// Of every tet. The deviations follow from those of the vertices, which are taken as independent and alike
/// in all directions, and larger by 1 / confidence. Without standard deviations the state is taken as exact.
std::vector<TetStretch> tetStretches(const TetTopology& volume, const MeshState& state);

}  // namespace softbody
