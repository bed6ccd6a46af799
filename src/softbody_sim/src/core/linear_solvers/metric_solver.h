#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "linear_solvers/factor_kernels.h"
#include "linear_solvers/positive_definite_solver.h"
#include "linear_solvers/split_inverse.h"
#include "simd/rows.h"

namespace softbody {

/// The global step of projective dynamics: solves A X = B for one matrix after another of one pattern, in the
/// precision T, from CHOLMOD's factor in double. A small A whose factor has served often is inverted: from
/// then on a solve is dense products.
template <typename T>
class MetricSolver {
 public:
  /// Rank-one changes up to which updating a factor costs less than factoring anew, whatever the body: about
  /// 24 for 300 tets, 50 for a thousand, more beyond (bench_projective_dynamics, `update`).
  static constexpr std::size_t kMaxUpdates = 16;

  /// @param lower compressed lower triangle of A, for its pattern.
  MetricSolver(const Eigen::SparseMatrix<double>& lower, Simd simd);

  /// @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// As PositiveDefiniteSolver's. Cheaper than factorize() for up to kMaxUpdates.
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
  int solves_ = 0;  ///< with the present factor
  bool inverted_ = false;
  std::optional<SplitInverse<T>> inverse_;  ///< where A is small
};

}  // namespace softbody
