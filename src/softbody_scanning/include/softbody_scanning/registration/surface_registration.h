#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// A surface that is to lie on another one.
struct RegisteredSurface {
  TriangleMesh mesh;        ///< [m]
  std::vector<float> seen;  ///< empty, or #V: 1 measured, 0 never seen
  Points colors;            ///< empty, or #V x 3
  /// Where the body stood: it was above this plane and touched it. If both surfaces have one, the body was
  /// turned over in between by at least 45 degrees.
  std::optional<Eigen::Hyperplane<double, 3>> table = std::nullopt;
};

/// A rigid motion of one surface onto another.
struct Registration {
  Eigen::Isometry3d T_fixed_moving = Eigen::Isometry3d::Identity();
  double misfit = 0.0;      ///< 0: equal surfaces and colours, 2: nothing fits
  double runner_up = 0.0;   ///< the least misfit of a motion that differs by more than 20 degrees
  bool ambiguous = false;   ///< neither the misfit nor the colours tell it clearly from such a motion
  double distance_m = 0.0;  ///< median distance of what was seen
};

/// Finds the motion. It starts at 600 rotations about the middle of the volume; point-to-plane ICP (Chen and
/// Medioni 1992) with Geman and McClure's weights, so that a part that one surface lacks has no effect. A
/// surface that was never seen lies outside of the body: the other surface is on it or inside, and no more is
/// asked of it. Among motions that fit alike the colours decide. What the other surface shows of the
/// underside touches the table: walls alone do not tell how high a body is. @throw std::invalid_argument if
/// the sizes differ by more than three times, or nothing was seen.
Registration registerSurfaces(const RegisteredSurface& moving, const RegisteredSurface& fixed);

}  // namespace softbody::scanning
