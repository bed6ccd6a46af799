#include "softbody_scanning/surface/distance_grid.h"

#include <algorithm>

namespace softbody::scanning {
namespace {

bool isOnBorder(const Eigen::Vector3i& i, const Eigen::Vector3i& size) {
  return (i.array() == 0).any() || (i.array() == size.array() - 1).any();
}

}  // namespace

DistanceGrid solidOf(const Volume& volume) {
  DistanceGrid grid{volume.box(), volume.size(), {}};
  grid.distances.resize(static_cast<std::size_t>(grid.size.x()) * grid.size.y() * grid.size.z());
  const float reach = static_cast<float>(grid.box.reach_m);
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x) {
        const Eigen::Vector3i index(x, y, z);
        grid.at(index) =
            isOnBorder(index, grid.size) ? reach : std::clamp(volume.distance(index), -reach, reach);
      }
  return grid;
}

void cutBelow(double height_m, DistanceGrid* grid) {
  const float reach = static_cast<float>(grid->box.reach_m);
  for (int z = 0; z < grid->size.z(); ++z) {
    const double under = height_m - grid->place({0, 0, z}).z();
    const float least = std::clamp(static_cast<float>(under), -reach, reach);
    for (int y = 0; y < grid->size.y(); ++y)
      for (int x = 0; x < grid->size.x(); ++x) grid->at({x, y, z}) = std::max(grid->at({x, y, z}), least);
  }
}

}  // namespace softbody::scanning
