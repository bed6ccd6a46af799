#pragma once

#include <Eigen/Geometry>
#include <unordered_map>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// Which material of the truth the material of a result is, from one frame on. It is another one where the
/// tracker took one of several poses that look alike.
struct MaterialMap {
  Nanoseconds first = 0;  ///< stamp from which it holds
  /// A rest place p of the result is the rest place motion * p of the truth [m].
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  /// By vertex of the input file: the vertex that the truth has there, or has nearest. Empty: the same
  /// vertex.
  std::unordered_map<int, int> parents;
};

}  // namespace softbody::evaluation
