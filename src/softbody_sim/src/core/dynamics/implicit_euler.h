#pragma once

#include <vector>

#include "dynamics/body_model.h"
#include "dynamics/body_state.h"
#include "softbody_sim/dynamics/simulator_config.h"
#include "time_step/incremental_potential.h"

namespace softbody {

/// Implicit Euler under targets, gravity and surroundings. Keeps its buffers from step to step.
class ImplicitEuler {
 public:
  /// @param damping fraction of the velocity lost per 1/30 s.
  ImplicitEuler(const SimulatorConfig& config, double damping) : config_(config), damping_(damping) {}

  /// Advances by a time; the stamp stays. With no elapsed time only the targets act.
  /// @throw std::runtime_error if the step has no finite solution.
  void step(BodyModel* model, const std::vector<Target>& targets, double elapsed_s,
            const Surroundings& surroundings, BodyState* body);

  /// Static equilibrium: a step of infinite length. @throw std::runtime_error as step() does, and
  /// std::invalid_argument if nothing holds a piece under loads.
  void settle(BodyModel* model, const std::vector<Target>& targets, const Surroundings& surroundings,
              BodyState* body);

 private:
  double startStep(BodyModel* model, const std::vector<Target>& targets, double elapsed_s, BodyState* body);
  void solve(BodyModel* model, const std::vector<Target>& targets, const Surroundings& surroundings,
             BodyState* body);

  SimulatorConfig config_;
  double damping_;
  IncrementalPotential free_;  ///< without targets and surroundings
  Points solution_;            ///< start of the minimisation, then its result [m]
  ContactState contact_;       ///< after the step
};

}  // namespace softbody
