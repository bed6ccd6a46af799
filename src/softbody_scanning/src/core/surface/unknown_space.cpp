#include "surface/unknown_space.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace softbody::scanning {
namespace {

constexpr float kOverRelaxation = 1.9f;  // best for gaps of some 60 grid points, 2 / (1 + pi / 60)
constexpr int kMostSweeps = 300;         // enough for them; in a larger gap the surface stays where it is
constexpr double kSettled = 1e-3;        // of the reach, in one sweep: moves no surface by a voxel

/// Offsets of the unknown places by the colour of a chess board: two of one colour are no neighbours.
std::array<std::vector<std::size_t>, 2> byColor(const std::vector<bool>& unknown,
                                                const Eigen::Vector3i& size) {
  std::array<std::vector<std::size_t>, 2> places;
  for (int z = 1; z + 1 < size.z(); ++z)
    for (int y = 1; y + 1 < size.y(); ++y)
      for (int x = 1; x + 1 < size.x(); ++x) {
        const std::size_t i = (static_cast<std::size_t>(z) * size.y() + y) * size.x() + x;
        if (unknown[i]) places[(x + y + z) % 2].push_back(i);
      }
  return places;
}

/// Unknown places on the border, each with the place inside next to it.
std::vector<std::pair<std::size_t, std::size_t>> unknownBorder(const std::vector<bool>& unknown,
                                                               const Eigen::Vector3i& size) {
  const auto offset = [&](const Eigen::Vector3i& i) {
    return (static_cast<std::size_t>(i.z()) * size.y() + i.y()) * size.x() + i.x();
  };
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) {
        const Eigen::Vector3i here(x, y, z);
        const Eigen::Vector3i inner = here.cwiseMax(1).cwiseMin(size - Eigen::Vector3i::Constant(2));
        if (inner != here && unknown[offset(here)]) places.emplace_back(offset(here), offset(inner));
      }
  return places;
}

/// Over-relaxes the places of one colour. @return the largest change.
float relax(const std::vector<std::size_t>& places, DistanceGrid* grid) {
  const std::size_t row = grid->size.x(), layer = row * grid->size.y();
  std::vector<float>& d = grid->distances;
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, places.size(), 4096), 0.0f,
      [&](const tbb::blocked_range<std::size_t>& range, float most) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const std::size_t i = places[k];
          const float sum = d[i - 1] + d[i + 1] + d[i - row] + d[i + row] + d[i - layer] + d[i + layer];
          const float change = kOverRelaxation * (sum / 6.0f - d[i]);
          d[i] += change;
          most = std::max(most, std::abs(change));
        }
        return most;
      },
      [](float a, float b) { return std::max(a, b); });
}

}  // namespace

void fillUnknown(const std::vector<bool>& unknown, DistanceGrid* grid) {
  const auto places = byColor(unknown, grid->size);
  const auto mirrors = unknownBorder(unknown, grid->size);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    for (const auto& [border, inner] : mirrors) grid->distances[border] = grid->distances[inner];
    const float change = std::max(relax(places[0], grid), relax(places[1], grid));
    if (change < kSettled * grid->box.reach_m) return;
  }
}

}  // namespace softbody::scanning
