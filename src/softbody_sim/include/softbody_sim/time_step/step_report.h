#pragma once

namespace softbody {

/// How the minimisation of the last step ended.
struct StepReport {
  int iterations = 0;
  bool converged = false;    ///< to the tolerance; otherwise `iterations` is the allowed maximum
  double last_move_m = 0.0;  ///< largest move of a vertex in the last iteration [m]
  double residual_n = 0.0;   ///< largest unbalanced force on a vertex, from the last evaluated gradient [N]
};

}  // namespace softbody
