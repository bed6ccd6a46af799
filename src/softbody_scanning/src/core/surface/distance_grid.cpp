#include "softbody_scanning/surface/distance_grid.h"

#include <algorithm>

namespace softbody::scanning {
namespace {

bool isOnBorder(const Eigen::Vector3i& i, const Eigen::Vector3i& size) {
  return (i.array() == 0).any() || (i.array() == size.array() - 1).any();
}

}  // namespace

DistanceGrid solidAbove(const Volume& volume, double clear_m) {
  DistanceGrid grid{volume.box(), volume.size(), {}};
  grid.distances.resize(static_cast<std::size_t>(grid.size.x()) * grid.size.y() * grid.size.z());
  const float reach = static_cast<float>(grid.box.reach_m);
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x) {
        const Eigen::Vector3i index(x, y, z);
        const float below = static_cast<float>(clear_m - volume.place(index).z());
        grid.at(index) = isOnBorder(index, grid.size)
                             ? reach
                             : std::clamp(std::max(volume.distance(index), below), -reach, reach);
      }
  return grid;
}

}  // namespace softbody::scanning
