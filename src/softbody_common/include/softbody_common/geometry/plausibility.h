#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "softbody_common/geometry/types.h"

/// What a sender can mean. Numbers beyond these limits are faults: they are refused, and change nothing.
namespace softbody {

/// Positions are sent in single precision. Farther from their origin they are rounded by more than half a
/// millimetre, which is more than the body's error.
constexpr double kLargestCoordinate_m = 1e4;

/// Pixels in a row or column of an image. Products of larger numbers could overflow.
constexpr std::uint32_t kLargestImageSide = 1u << 14;

/// Targets in one message; the tracker sends some thousands. The time of a step grows with them.
constexpr std::size_t kMostTargets = 50'000;

/// Triangles of a visual mesh; the time of a frame grows with them.
constexpr std::size_t kMostTriangles = 2'000'000;

inline bool isPlausible(const Eigen::Vector3d& position) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= kLargestCoordinate_m;
}

/// A measurement that is farther than this from its expected place does not belong to the body [m]: ten times
/// the body's size, and at least 1 m, because small pieces are carried around.
inline double reachOf(const Points& rest_vertices) {
  if (rest_vertices.rows() == 0) return 1.0;
  const double size = (rest_vertices.colwise().maxCoeff() - rest_vertices.colwise().minCoeff()).norm();
  return std::max(1.0, 10.0 * size);
}

/// Whether every vertex is within a reach of its expected place. @param vertices, expected #V by 3 [m].
inline bool isWithinReach(const Points& vertices, const Points& expected, double reach) {
  return vertices.rows() == expected.rows() &&
         (vertices.rows() == 0 || (vertices - expected).rowwise().squaredNorm().maxCoeff() <= reach * reach);
}

}  // namespace softbody
