#pragma once

#include <string>
#include <vector>

#include "softbody_sim/constraints/surroundings.h"
#include "tools/held_regions.h"
#include "tools/simulate_options.h"

namespace softbody {

/// What acts on the body of `simulate`, over a run.
struct SimulationProblem {
  SimulationProblem(const SimulateOptions& options, const Points& rest);

  /// @param share of the motions, from 0 to 1.
  Surroundings at(double share) const;
  /// Upper bound of the way of a pin or an obstacle [m].
  double longestWay() const;

  HeldRegions held;
  Points loads;                             ///< #V by 3 [N]
  std::vector<Obstacle> obstacles;          ///< at the start
  std::vector<Eigen::Vector3d> shifts;      ///< per obstacle, over the run [m]
  std::vector<std::string> obstacle_names;  ///< as in the table
};

}  // namespace softbody
