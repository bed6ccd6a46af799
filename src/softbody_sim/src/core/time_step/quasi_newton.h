#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/time_step/step_report.h"

namespace softbody {

struct MinimizerOptions {
  int max_iterations = 20;
  double tolerance = 2e-4;  ///< converged when the unbalanced forces are this share of the external ones
  int history = 5;          ///< moves that L-BFGS keeps; 0: plain projective dynamics without line search
};

/// An energy and the forces in its gradient.
struct StepEnergy {
  StepEnergy(double energy) : energy_j(energy) {}

  double energy_j;
  double unbalanced_n = std::numeric_limits<double>::infinity();  ///< sum over vertices and components
  double external_n = 0.0;                                        ///< the same of the forces from outside
};

/// Minimises an energy of vertex positions (one row per vertex) by L-BFGS with a constant metric as initial
/// Hessian. Without history an iteration is one local and one global step of projective dynamics. With
/// history large rotations and sliding converge, too (Liu, Bouaziz, Kavan 2017). A backtracking line search
/// ensures that the energy never rises.
template <typename Positions>
class QuasiNewton {
 public:
  /// Returns the energy; sets its gradient [N].
  using Energy = std::function<StepEnergy(const Positions& x, Positions* gradient)>;
  /// X = A^-1 B with the metric A.
  using Metric = std::function<void(const Positions& B, Positions* X)>;

  /// @param rows number of rows of the positions.
  explicit QuasiNewton(Eigen::Index rows);

  /// Allocates nothing, apart from `energy` and `metric`. @param x start, then result.
  StepReport minimize(const Energy& energy, const Metric& metric, const MinimizerOptions& options,
                      Positions* x);

 private:
  using Scalar = typename Positions::Scalar;
  static constexpr int kHistory = 5;  ///< as Liu et al. 2017; each costs two products a step
  struct Pair {
    Positions move;  ///< x_{k+1} - x_k
    Positions gradient_change;
    double inverse_product = 0.0;  ///< 1 / <move, gradient_change>
  };

  StepReport iterate(const Energy& energy, const Metric& metric, const MinimizerOptions& options,
                     Positions* x);
  void findDirection(const Metric& metric);
  bool searchLine(const Energy& energy, Positions* x, double* step);
  bool fallsEnough(double trial_energy, double slope, double step) const;
  bool isBalanced(const MinimizerOptions& options) const;
  bool isRounding(double energy_before);
  double rounding() const;
  void describe(StepReport* report) const;
  void storeMove();
  Pair& recent(int age) { return pairs_[static_cast<std::size_t>((newest_ - age + kHistory) % kHistory)]; }

  std::vector<Pair> pairs_;
  int history_ = kHistory;
  int pair_count_ = 0;
  int newest_ = 0;
  StepEnergy energy_{0.0};
  double lowest_n_ = 0.0;  ///< unbalanced forces
  double extent_ = 0.0;    ///< of the positions [m]
  int idle_ = 0;           ///< iterations without a gain
  Positions gradient_, direction_, residual_, trial_, trial_gradient_, trial_gradient_change_;
};

}  // namespace softbody
