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
/// is a dense product. In single precision, the factor of a large A is stored in half precision where that
/// suffices for a metric.
template <typename T>
class GlobalStepSolver {
 public:
  /// Up to this many rank-one changes, an update is faster than a new factorisation for a body of any size.
  /// The true limit is about 24 for 300 tets, 50 for 1000, and larger for more (bench_projective_dynamics,
  /// `update`).
  static constexpr std::size_t kMaxUpdates = 16;

  /// Larger matrices are not inverted: a dense product would take longer than two sparse triangular solves.
  static constexpr int kLargestInverse = 500;

  /// @param lower compressed lower triangle of A, for its pattern.
  GlobalStepSolver(const Eigen::SparseMatrix<double>& lower, Simd simd);

  /// @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// As PositiveDefiniteSolver::update. Faster than factorize() for up to kMaxUpdates vectors.
  void update(const std::vector<TetVector>& added, const std::vector<TetVector>& removed);

  /// X = A^-1 B, both paddedRows(#V).
  void solve(const Rows<T>& B, Rows<T>* X);
  /// The same for positions of another precision, without an inverse.
  template <typename Number>
  void solveSparse(const Rows<Number>& B, Rows<Number>* X);

 private:
  void readFactor();
  void addToSums(const std::vector<TetVector>& vectors, double sign);
  bool isAccurate();
  void invert();

  PositiveDefiniteSolver factorization_;
  PanelSolve<T> solve_panels_;
  int count_;
  bool reads_halves_;
  Eigen::VectorXd sums_;  ///< of the rows of A
  PanelFactor<T> factor_;
  Eigen::Matrix<T, Eigen::Dynamic, 1>
      scale_;  ///< of the factor's rows, so that A has a unit diagonal, as of the last factorize()
  Eigen::Matrix<T, Eigen::Dynamic, 1> scratch_;
  Rows<T> permuted_;
  int solves_ = 0;  ///< with the current factor
  bool inverted_ = false;
  std::optional<SplitInverse<T>> inverse_;  ///< only for a small A
};

}  // namespace softbody
