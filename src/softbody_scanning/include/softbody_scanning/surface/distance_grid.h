#pragma once

#include <vector>

#include "softbody_scanning/fusion/volume.h"

namespace softbody::scanning {

/// Signed distances [m], outside positive, on the grid points of a volume.
struct DistanceGrid {
  FusionBox box;
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  std::vector<float> distances;  ///< x fastest

  Eigen::Vector3d place(const Eigen::Vector3i& i) const {
    return box.box.min() + box.voxel_m * i.cast<double>();
  }
  float& at(const Eigen::Vector3i& i) {
    return distances[(static_cast<std::size_t>(i.z()) * size.y() + i.y()) * size.x() + i.x()];
  }
};

/// The solid of a volume. Nothing reaches the volume's border.
DistanceGrid solidOf(const Volume& volume);

/// Takes away what is below a height.
void cutBelow(double height_m, DistanceGrid* grid);

}  // namespace softbody::scanning
