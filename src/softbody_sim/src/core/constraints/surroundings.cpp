#include "softbody_sim/constraints/surroundings.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace softbody {

void requireUsable(const Surroundings& surroundings, Eigen::Index vertex_count) {
  for (const Pin& pin : surroundings.pins) {
    if (pin.vertex < 0 || pin.vertex >= vertex_count) {
      throw std::invalid_argument(
          fmt::format("a pin holds vertex {}; allowed: 0 to {}", pin.vertex, vertex_count - 1));
    }
    if (!pin.position.allFinite()) throw std::invalid_argument("a pin's position is not finite");
    if (!std::isfinite(pin.accuracy_m) || pin.accuracy_m < 0.0)
      throw std::invalid_argument("a pin's accuracy is negative or not finite");
  }
  for (const Obstacle& obstacle : surroundings.obstacles) {
    if (!obstacle.pose.matrix().allFinite()) throw std::invalid_argument("an obstacle's pose is not finite");
  }
  const Points& loads = surroundings.loads;
  if (loads.size() > 0 && loads.rows() != vertex_count)
    throw std::invalid_argument(
        fmt::format("there are {} loads for {} vertices", loads.rows(), vertex_count));
  if (!loads.allFinite()) throw std::invalid_argument("a load is not finite");
}

}  // namespace softbody
