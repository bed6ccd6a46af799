#pragma once

#include <functional>
#include <vector>

#include "core/positive_definite_solver.h"
#include "softbody_common/types.h"
#include "softbody_sim/simulator.h"

namespace softbody {

/// Minimises energies of vertex positions by L-BFGS whose initial Hessian is a constant metric: without
/// history one iteration is exactly the local and global step of projective dynamics, with it large rotations
/// and sliding converge (Liu, Bouaziz, Kavan 2017). A backtracking line search keeps the energy from ever
/// rising.
class QuasiNewton {
 public:
  /// Energy, and its gradient #V by 3.
  using Energy = std::function<double(const Points& x, Points* gradient)>;
  struct Options {
    int max_iterations = 20;
    double tolerance_m = 1e-6;  ///< converged when no vertex moves further in a full iteration
  };

  explicit QuasiNewton(Eigen::Index vertex_count);

  /// Allocates nothing but what `energy` does. @param x start, then result.
  StepReport minimize(const Energy& energy, PositiveDefiniteSolver& metric, const Options& options,
                      Points* x);

 private:
  static constexpr int kHistory = 5;
  struct Pair {
    Points move;  ///< x_{k+1} - x_k
    Points gradient_change;
    double inverse_product = 0.0;  ///< 1 / <move, gradient_change>
  };

  void findDirection(PositiveDefiniteSolver& metric);
  bool searchLine(const Energy& energy, Points* x, double* step);
  void remember();
  Pair& recent(int age) { return pairs_[static_cast<std::size_t>((newest_ - age + kHistory) % kHistory)]; }

  std::vector<Pair> pairs_;
  int pair_count_ = 0;
  int newest_ = 0;
  double energy_ = 0.0;
  Points gradient_, direction_, residual_, trial_, trial_gradient_, trial_gradient_change_;
};

}  // namespace softbody
