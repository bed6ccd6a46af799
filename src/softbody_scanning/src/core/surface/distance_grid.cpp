#include "softbody_scanning/surface/distance_grid.h"

#include <algorithm>

#include "surface/unknown_space.h"

namespace softbody::scanning {
namespace {

bool isOnBorder(const Eigen::Vector3i& i, const Eigen::Vector3i& size) {
  return (i.array() == 0).any() || (i.array() == size.array() - 1).any();
}

/// No view saw into this place.
bool isUnknown(const PlaceEvidence& place) { return !(place.weight > 0.0f) && place.behind > 0; }

/// Nothing reaches the border, so that the surface is closed.
void closeBorder(DistanceGrid* grid) {
  for (int z = 0; z < grid->size.z(); ++z)
    for (int y = 0; y < grid->size.y(); ++y)
      for (int x = 0; x < grid->size.x(); ++x)
        if (isOnBorder({x, y, z}, grid->size)) grid->at({x, y, z}) = static_cast<float>(grid->box.reach_m);
}

}  // namespace

DistanceGrid solidOf(const Volume& volume) {
  DistanceGrid grid{volume.box(), volume.size(), {}};
  grid.distances.reserve(static_cast<std::size_t>(grid.size.x()) * grid.size.y() * grid.size.z());
  std::vector<bool> unknown;
  unknown.reserve(grid.distances.capacity());
  const float reach = static_cast<float>(grid.box.reach_m);
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x) {
        grid.distances.push_back(std::clamp(volume.distance({x, y, z}), -reach, reach));
        unknown.push_back(isUnknown(volume.at({x, y, z})));
      }
  fillUnknown(unknown, &grid);
  closeBorder(&grid);
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
