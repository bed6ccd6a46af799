#include "surface/unknown_space.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace softbody::scanning {
namespace {

constexpr float kOverRelaxation = 1.9f;
constexpr int kMostSweeps = 300;
constexpr double kSettled = 1e-3;  // of the reach, in one sweep

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
  const auto layer = static_cast<std::ptrdiff_t>(grid->size.x()) * grid->size.y();
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    for (std::ptrdiff_t i = 0; i < layer; ++i)
      if (unknown[i]) grid->distances[i] = grid->distances[i + layer];
    const float change = std::max(relax(places[0], grid), relax(places[1], grid));
    if (change < kSettled * grid->box.reach_m) return;
  }
}

}  // namespace softbody::scanning
