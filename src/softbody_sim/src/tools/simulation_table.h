#pragma once

#include <string>
#include <vector>

#include "softbody_sim/dynamics/simulator.h"
#include "tools/simulation_problem.h"

namespace softbody {

/// The CSV table of `simulate`: one row per step.
class SimulationTable {
 public:
  /// @param probe vertices whose mean displacement is a column.
  SimulationTable(const SimulationProblem& problem, std::vector<int> probe)
      : problem_(problem), probe_(std::move(probe)) {}

  std::string header() const;
  /// @param before vertices one step earlier; @param share of the motions.
  std::string row(int step, double time_s, double time_step_s, const Points& before, double share,
                  const StepReport& report, const Simulator& simulator) const;

 private:
  std::string reactions(double share, const Simulator& simulator) const;

  const SimulationProblem& problem_;
  std::vector<int> probe_;
};

/// A sentence per held region: what the body does to it.
std::string describeHeld(const HeldRegions& held, double share, const Simulator& simulator);

}  // namespace softbody
