#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "core/factor_kernels.h"
#include "core/positive_definite_solver.h"
#include "core/rows.h"

namespace softbody {

/// The global step of projective dynamics: solves A X = B for one matrix after another of one pattern, in the
/// precision T, from CHOLMOD's factor in double. A small A whose factor has served often is inverted: from
/// then on a solve is one dense product.
template <typename T>
class MetricSolver {
 public:
  /// @param lower compressed lower triangle of A, for its pattern.
  MetricSolver(const Eigen::SparseMatrix<double>& lower, Simd simd);

  /// @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// As PositiveDefiniteSolver's. Cheaper than factorize() for a few.
  void update(const std::vector<TetVector>& added, const std::vector<TetVector>& removed);

  /// X = A^-1 B, both paddedRows(#V).
  void solve(const Rows<T>& B, Rows<T>* X);

 private:
  struct alignas(64) Lanes {
    T lane[16];
  };

  void takeFactor();
  void invert();
  T* inverseColumn(int column) {
    return inverse_[static_cast<std::size_t>(column) * static_cast<std::size_t>(inverse_stride_ / 16)].lane;
  }

  PositiveDefiniteSolver factorization_;
  PanelSolve<T> solve_panels_;
  DenseProduct<T> multiply_;
  int count_;
  PanelFactor<T> factor_;
  Rows<T> permuted_;
  int solves_ = 0;  ///< with the present factor
  int inverse_stride_ = 0;
  bool inverted_ = false;
  std::vector<Lanes> inverse_;  ///< columns, inverse_stride_ numbers apart
};

}  // namespace softbody
