#include "body/state_check.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

constexpr double kCollapsed = 1e-3;  // of the size at rest; no soft body can be pressed to that

/// The middle vertex along each axis, which a few vertices far away do not move.
Eigen::RowVector3d middleOf(const Points& vertices) {
  Eigen::RowVector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values(vertices.col(axis).begin(), vertices.col(axis).end());
    middle[axis] = median(&values);
  }
  return middle;
}

double sizeOf(const Points& vertices) {
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

}  // namespace

void requireDrawable(const MeshState& state, std::uint32_t revision, const Points& rest) {
  const Points& vertices = state.vertices;
  if (state.revision != revision || vertices.rows() != rest.rows()) {
    throw std::invalid_argument(
        fmt::format("the state has {} vertices of revision {}, but the topology has {} of revision {}",
                    vertices.rows(), state.revision, rest.rows(), revision));
  }
  const double size = sizeOf(rest);
  if (sizeOf(vertices) < kCollapsed * size) {
    throw std::invalid_argument(
        fmt::format("all vertices are at ({:.3g}, {:.3g}, {:.3g}), but the body spans {:.3g} m at rest",
                    vertices(0, 0), vertices(0, 1), vertices(0, 2), size));
  }
  Eigen::Index farthest = 0;
  const double distance = (vertices.rowwise() - middleOf(vertices)).rowwise().norm().maxCoeff(&farthest);
  if (distance <= reachOf(rest)) return;
  throw std::invalid_argument(
      fmt::format("vertex {} is {:.3g} m away from the middle of the body, which spans {:.3g} m at rest",
                  farthest, distance, size));
}

}  // namespace softbody
