#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "softbody_common/types.h"

namespace softbody {

/// Solves A X = B for sparse symmetric positive definite matrices A of one pattern (CHOLMOD). The same on
/// every run: no threads, no BLAS.
class PositiveDefiniteSolver {
 public:
  /// Orders and analyses the pattern, once. @param lower compressed lower triangle of A.
  explicit PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower);
  ~PositiveDefiniteSolver();

  /// @param lower of the analysed pattern. @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// X = A^-1 B, both #V by 3. Allocates on the first call only.
  void solve(const Points& B, Points* X);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
