#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "softbody_common/types.h"

namespace softbody {

/// Where a body that goes on as it moved will be: constant velocity and spin of its rigid part.
class RigidPrediction {
 public:
  explicit RigidPrediction(const Points& rest_vertices) : rest_(rest_vertices) {}

  /// A state of the volume at a stamp; one not after the last starts anew.
  void observe(const Points& vertices, Nanoseconds stamp);

  /// The motion since the last observed state until a stamp; identity without two states, or long after them.
  Eigen::Isometry3d motionUntil(Nanoseconds stamp) const;

  void reset() { last_.reset(), before_.reset(); }

 private:
  struct Placed {
    Eigen::Isometry3d pose;
    Eigen::Vector3d center;
    Nanoseconds stamp;
  };

  Points rest_;
  std::optional<Placed> last_, before_;
};

}  // namespace softbody
