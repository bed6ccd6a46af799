#include "tools/simulation_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace softbody {

SimulationProblem::SimulationProblem(const SimulateOptions& o, const Points& rest)
    : held(heldRegionsOf(o, rest)), loads(loadsOf(o, rest)) {
  if (!std::isnan(o.ground)) {
    obstacles.push_back(Obstacle::plane());
    obstacles.back().pose.translation().z() = o.ground;
    obstacles.back().friction = o.friction;
    shifts.emplace_back(0.0, 0.0, 0.0);
    obstacle_names.push_back("ground");
  }
  for (std::size_t k = 0; k < o.pushers.size(); ++k) {
    const Eigen::Map<const Eigen::Matrix3d> columns(o.pushers[k].data());  // centre, sizes, motion
    obstacles.push_back(Obstacle::box(columns.col(1), 0.0));
    obstacles.back().pose.translation() = columns.col(0);
    shifts.push_back(columns.col(2));
    obstacle_names.push_back(fmt::format("pusher_{}", k + 1));
  }
}

Surroundings SimulationProblem::at(double share) const {
  Surroundings surroundings{held.pinsAt(share), obstacles, false, loads};
  for (std::size_t k = 0; k < shifts.size(); ++k)
    surroundings.obstacles[k].pose.pretranslate(share * shifts[k]);
  return surroundings;
}

double SimulationProblem::longestWay() const {
  double longest = held.longestWay();
  for (const Eigen::Vector3d& shift : shifts) longest = std::max(longest, shift.norm());
  return longest;
}

}  // namespace softbody
