#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// Heights of a body's surface over a line, from a point on the line on in equal steps [m].
struct BodyProfile {
  std::vector<double> heights;

  /// Linear between the steps. @param place distance from the line's start; limited to the profile.
  double at(double place) const;
};

/// @param side unit vector of the heights; a height is that of the outermost point. Where the body does not
/// reach the line, the height is that of the next place. @param along unit vector of the line, normal to
/// side.
BodyProfile profileOf(const TriangleMesh& body, const Eigen::Vector3d& start, const Eigen::Vector3d& along,
                      const Eigen::Vector3d& side);

}  // namespace softbody::virtual_camera
