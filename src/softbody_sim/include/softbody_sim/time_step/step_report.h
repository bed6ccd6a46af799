#pragma once

namespace softbody {

/// How the minimisation of the last step ended.
struct StepReport {
  int iterations = 0;
  bool converged = false;    ///< the forces balance to the tolerance
  double last_move_m = 0.0;  ///< largest move of a vertex in the last iteration [m]
  double residual_n = 0.0;   ///< unbalanced forces, summed over vertices and components [N]
  double external_n = 0.0;   ///< the same of the forces from outside: loads, inertia, springs, pins [N]
};

}  // namespace softbody
