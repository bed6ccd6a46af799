#pragma once

#include "softbody_common/geometry/types.h"
#include "softbody_sim/time_step/step_report.h"
#include "time_step/incremental_potential.h"

namespace softbody {

/// Solves one step of implicit Euler: minimises elastic energy plus incremental potential.
class StepSolver {
 public:
  virtual ~StepSolver() = default;

  /// @param x start, then result, #V by 3 [m]. @throw std::runtime_error if a linear system cannot be solved.
  virtual StepReport minimize(const IncrementalPotential& potential, Points* x) = 0;

  /// Forgets what a simulation from other shapes has left. @param x first shape of the next one [m].
  virtual void restart(const Points& x) { static_cast<void>(x); }

  /// Elastic energy [J]; adds its gradient [N], #V by 3.
  virtual double addElasticity(const Points& x, Points* gradient) const = 0;
};

}  // namespace softbody
