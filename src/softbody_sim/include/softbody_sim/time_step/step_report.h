#pragma once

namespace softbody {

/// How the minimisation of the last step ended.
struct StepReport {
  int iterations = 0;
  bool converged = false;    ///< the forces balance to the tolerance
  double last_move_m = 0.0;  ///< largest move of a vertex in the last iteration [m]
  double residual_n = 0.0;   ///< largest unbalanced force on a vertex [N]
  double unbalanced_n = 0.0; ///< sum of all vertices' unbalanced forces, by components [N]
  double external_n = 0.0;   ///< sum of the forces that act from outside: loads, inertia, springs [N]
};

}  // namespace softbody
