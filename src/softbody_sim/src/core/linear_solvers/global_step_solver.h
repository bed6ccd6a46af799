#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "linear_solvers/factor_kernels.h"
#include "linear_solvers/positive_definite_solver.h"
#include "linear_solvers/split_inverse.h"
#include "simd/rows.h"

namespace softbody {

/// The global step of projective dynamics: solves A X = B for matrices of one pattern, in the precision T,
/// with CHOLMOD's factor in double. If A is small and its factor is used often, A is inverted; then a solve
/// is a dense product.
template <typename T>
class GlobalStepSolver {
 public:
  /// Up to this many rank-one changes, an update is faster than a new factorisation for a body of any size.
  /// The true limit is about 24 for 300 tets, 50 for 1000, and larger for more (bench_projective_dynamics,
  /// `update`).
  static constexpr std::size_t kMaxUpdates = 16;

  /// @param lower compressed lower triangle of A, for its pattern.
  GlobalStepSolver(const Eigen::SparseMatrix<double>& lower, Simd simd);

  /// @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// As PositiveDefiniteSolver::update. Faster than factorize() for up to kMaxUpdates vectors.
  void update(const std::vector<TetVector>& added, const std::vector<TetVector>& removed);

  /// X = A^-1 B, both paddedRows(#V).
  void solve(const Rows<T>& B, Rows<T>* X);

 private:
  void packFactor();
  void invert();

  PositiveDefiniteSolver factorization_;
  PanelSolve<T> solve_panels_;
  int count_;
  PanelFactor<T> factor_;
  Rows<T> permuted_;
  int solves_ = 0;  ///< with the current factor
  bool inverted_ = false;
  std::optional<SplitInverse<T>> inverse_;  ///< only for a small A
};

}  // namespace softbody
