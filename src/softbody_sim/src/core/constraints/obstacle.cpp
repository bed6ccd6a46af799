#include "softbody_sim/constraints/obstacle.h"

#include <fmt/format.h>

#include <stdexcept>

namespace softbody {

Obstacle Obstacle::plane() {
  Obstacle obstacle;
  obstacle.half_space = true;
  return obstacle;
}

Obstacle Obstacle::sphere(double radius_m) {
  Obstacle obstacle;
  obstacle.radius = radius_m;
  return obstacle;
}

Obstacle Obstacle::capsule(double radius_m, double length_m) {
  Obstacle obstacle = sphere(radius_m);
  obstacle.half_extents.z() = 0.5 * length_m;
  return obstacle;
}

Obstacle Obstacle::box(const Eigen::Vector3d& sizes_m, double rounding_m) {
  if (!(rounding_m >= 0.0 && 2.0 * rounding_m <= sizes_m.minCoeff())) {
    throw std::invalid_argument(fmt::format("the rounding of a box is {} m; allowed: 0 to {} m", rounding_m,
                                            0.5 * sizes_m.minCoeff()));
  }
  Obstacle obstacle = sphere(rounding_m);
  obstacle.half_extents = 0.5 * sizes_m - Eigen::Vector3d::Constant(rounding_m);
  return obstacle;
}

SurfaceDistance distanceTo(const Obstacle& obstacle, const Eigen::Vector3d& point) {
  if (obstacle.half_space) return {point.z(), Eigen::Vector3d::UnitZ()};
  const Eigen::Vector3d nearest = point.cwiseMax(-obstacle.half_extents).cwiseMin(obstacle.half_extents);
  const Eigen::Vector3d offset = point - nearest;
  const double distance = offset.norm();
  if (distance > 0.0) return {distance - obstacle.radius, offset / distance};
  // Inside the box: the nearest side gives the distance.
  Eigen::Index axis = 0;
  const double depth = (obstacle.half_extents - point.cwiseAbs()).minCoeff(&axis);
  return {-depth - obstacle.radius, (point[axis] < 0.0 ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis)};
}

}  // namespace softbody
