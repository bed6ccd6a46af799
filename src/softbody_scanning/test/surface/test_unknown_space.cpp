#include "surface/unknown_space.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace softbody::scanning {
namespace {

constexpr float kReach = 4e-3f;

/// A grid of 1 mm that is inside everywhere.
DistanceGrid solidGrid(const Eigen::Vector3i& size) {
  const Eigen::Vector3d longest = 1e-3 * (size.cast<double>() - Eigen::Vector3d::Ones());
  DistanceGrid grid{{{Eigen::Vector3d::Zero(), longest}, 1e-3, kReach}, size, {}};
  grid.distances.assign(static_cast<std::size_t>(size.prod()), -kReach);
  return grid;
}

template <typename Test>
std::vector<bool> placesWhere(const Eigen::Vector3i& size, const Test& test) {
  std::vector<bool> places;
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) places.push_back(test(Eigen::Vector3i(x, y, z)));
  return places;
}

TEST(UnknownSpace, isHarmonic) {
  // Of third degree, and harmonic on the grid as well: second differences of x^3 - 3 x z^2 cancel exactly.
  const auto harmonic = [](const Eigen::Vector3i& i) {
    const Eigen::Vector3d p = i.cast<double>() - Eigen::Vector3d(10, 10, 10);
    return static_cast<float>(1e-6 * (p.x() * p.x() * p.x() - 3.0 * p.x() * p.z() * p.z() + p.y() * p.z()));
  };
  const Eigen::Vector3i size(21, 21, 21);
  DistanceGrid grid = solidGrid(size);
  const std::vector<bool> unknown =
      placesWhere(size, [](const Eigen::Vector3i& i) { return (i.array() - 10).abs().maxCoeff() < 8; });
  std::size_t next = 0;
  placesWhere(size, [&](const Eigen::Vector3i& i) {
    if (!unknown[next++]) grid.at(i) = harmonic(i);
    return true;
  });
  fillUnknown(unknown, &grid);
  placesWhere(size, [&](const Eigen::Vector3i& i) {
    EXPECT_NEAR(grid.at(i), harmonic(i), 0.01 * kReach);
    return true;
  });
}

TEST(UnknownSpace, whatStandsOnTheBottomStaysInside) {
  const Eigen::Vector3i size(30, 30, 20);
  DistanceGrid grid = solidGrid(size);
  // A block of 10 mm: its sides are seen, its middle and underside are not.
  const std::vector<bool> unknown = placesWhere(size, [](const Eigen::Vector3i& i) {
    return (i.head<2>().array() - 15).abs().maxCoeff() < 5 && i.z() < 10;
  });
  placesWhere(size, [&](const Eigen::Vector3i& i) {
    if (!((i.head<2>().array() - 15).abs().maxCoeff() < 9 && i.z() < 14)) grid.at(i) = kReach;
    return true;
  });
  const DistanceGrid solid = grid;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i]) grid.distances[i] = kReach;
  fillUnknown(unknown, &grid);
  for (std::size_t i = 0; i < unknown.size(); ++i)
    EXPECT_NEAR(grid.distances[i], solid.distances[i], 0.01 * kReach);
}

}  // namespace
}  // namespace softbody::scanning
