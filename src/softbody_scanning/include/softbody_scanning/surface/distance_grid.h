#pragma once

#include <vector>

#include "softbody_scanning/fusion/volume.h"

namespace softbody::scanning {

/// Signed distances [m], outside positive, on the grid points of a volume.
struct DistanceGrid {
  FusionBox box;
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  std::vector<float> distances;  ///< x fastest

  float& at(const Eigen::Vector3i& i) {
    return distances[(static_cast<std::size_t>(i.z()) * size.y() + i.y()) * size.x() + i.x()];
  }
};

/// The solid of a volume above the table z = 0. @param clear_m height below which the table and what stands
/// on it are not told apart.
DistanceGrid solidAbove(const Volume& volume, double clear_m);

}  // namespace softbody::scanning
