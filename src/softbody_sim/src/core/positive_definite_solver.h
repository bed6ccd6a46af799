#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "softbody_common/types.h"

namespace softbody {

/// Borrowed view of a factor: A(order, order) = L L^T, each column of L with its diagonal first and rows
/// ascending.
struct CholeskyView {
  int count;
  const int* order;       ///< #V
  const int* starts;      ///< per column, in rows and values
  const int* row_counts;  ///< per column
  const int* rows;
  const double* values;
};

/// Solves A X = B for sparse symmetric positive definite matrices A of one pattern (CHOLMOD). The same on
/// every run: no threads, no BLAS.
class PositiveDefiniteSolver {
 public:
  /// Orders and analyses the pattern, once. @param lower compressed lower triangle of A.
  explicit PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower);
  ~PositiveDefiniteSolver();

  /// @param lower of the analysed pattern. @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// Of the last factorize(), until the next.
  CholeskyView factor() const;

  /// X = A^-1 B, both #V by 3. Allocates on the first call only.
  void solve(const Points& B, Points* X);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
