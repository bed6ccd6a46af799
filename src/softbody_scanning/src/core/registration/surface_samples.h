#pragma once

#include <vector>

#include "softbody_scanning/registration/surface_registration.h"

namespace softbody::scanning {

/// A point of a surface.
struct SurfaceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d color = Eigen::Vector3d::Zero();     ///< zero without colours
};

/// Points of what was seen; each has an equal share of the area. Evenly spread, so no seed.
/// @throw std::invalid_argument if nothing was seen.
std::vector<SurfaceSample> sampleSeen(const RegisteredSurface& surface, int count);

}  // namespace softbody::scanning
