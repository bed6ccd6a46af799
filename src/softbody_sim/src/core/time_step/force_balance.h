#pragma once

#include <vector>

#include "time_step/incremental_potential.h"
#include "time_step/quasi_newton.h"

namespace softbody {

/// Sums the forces of a step: what acts from outside, and what of it elasticity does not balance. At a pinned
/// vertex the pin balances every force. There its stiff spring is left out, because its rounding exceeds the
/// other forces, and elasticity counts as the force from outside.
template <typename Positions>
class ForceBalance {
 public:
  /// Energy and forces of a step. @param addElasticity returns the elastic energy and adds its gradient.
  /// @param gradient of the potential alone, then of the step [N].
  template <typename AddElasticity>
  StepEnergy complete(const IncrementalPotential& potential, double potential_j, AddElasticity addElasticity,
                      Positions* gradient) {
    const std::vector<int>& pinned = potential.pinned;
    pins_.setZero(static_cast<Eigen::Index>(pinned.size()), Positions::ColsAtCompileTime);
    takePins(pinned, gradient);
    StepEnergy step(potential_j);
    step.external_n = potential.reference_force_n + sumOf(*gradient);
    step.energy_j += addElasticity(gradient);
    for (const int v : pinned) step.external_n += static_cast<double>(gradient->row(v).cwiseAbs().sum());
    takePins(pinned, gradient);
    step.unbalanced_n = sumOf(*gradient);
    for (std::size_t k = 0; k < pinned.size(); ++k)
      gradient->row(pinned[k]) = pins_.row(static_cast<Eigen::Index>(k));
    return step;
  }

 private:
  static double sumOf(const Positions& forces) { return static_cast<double>(forces.cwiseAbs().sum()); }
  /// Moves the pinned rows of the gradient into pins_.
  void takePins(const std::vector<int>& pinned, Positions* gradient) {
    for (std::size_t k = 0; k < pinned.size(); ++k) {
      pins_.row(static_cast<Eigen::Index>(k)) += gradient->row(pinned[k]);
      gradient->row(pinned[k]).setZero();
    }
  }

  Positions pins_;  ///< gradient at the pinned vertices
};

}  // namespace softbody
