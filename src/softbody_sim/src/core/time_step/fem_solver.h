#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "fem/fem_elasticity.h"
#include "tets/block_tet_matrix.h"
#include "time_step/force_balance.h"
#include "time_step/step_solver.h"

namespace softbody {

/// Implicit Euler by Newton's method with a backtracking line search (Kang et al. 2022, eq. 5-9, iterated to
/// convergence instead of one linearised step). Uses the projected Hessian, near the end the exact one.
/// CHOLMOD solves the linear systems and analyses their pattern once. Accurate rather than fast.
class FemSolver : public StepSolver {
 public:
  struct Options {
    int max_iterations = 20;
    double tolerance = 2e-4;  ///< as MinimizerOptions
  };

  /// @throw std::invalid_argument if the volume of a rest tet is not positive.
  FemSolver(const TetTopology& topology, Elasticity elasticity, const ElasticMaterials& materials,
            const Options& options);
  ~FemSolver() override;

  StepReport minimize(const IncrementalPotential& potential, Points* x) override;
  double addElasticity(const Points& x, Points* gradient) const override;

 private:
  struct Factor;
  enum class Hessian { kExact, kProjected };

  StepEnergy evaluate(const IncrementalPotential& potential, const Points& x, Points* gradient);
  bool findDirection(const IncrementalPotential& potential, const Points& x, Hessian kind);
  const Eigen::SparseMatrix<double>& systemAt(const IncrementalPotential& potential, const Points& x);
  bool solveShifted(const Eigen::SparseMatrix<double>& system, double shift);
  bool searchLine(const IncrementalPotential& potential, Points* x, double* step);

  FemElasticity elasticity_;
  Options options_;
  BlockTetMatrix hessian_;
  Eigen::SparseMatrix<double> coupled_hessian_;  ///< with the entries of springs between two tets
  std::unique_ptr<Factor> factor_;
  StepEnergy energy_{0.0};
  ForceBalance<Points> balance_;
  Points gradient_, direction_, trial_, trial_gradient_;
};

}  // namespace softbody
