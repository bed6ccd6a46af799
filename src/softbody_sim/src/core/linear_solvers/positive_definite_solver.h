#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "softbody_common/types.h"
#include "tets/tet_matrix.h"

namespace softbody {

/// View of a factor: A(order, order) = L D L^T, where L has ones on the diagonal. The rows of each column
/// ascend, and the diagonal entries hold D.
struct CholeskyView {
  int count;
  const int* order;       ///< #V
  const int* starts;      ///< per column: first index in `rows` and `values`
  const int* row_counts;  ///< per column
  const int* rows;
  const double* values;
};

/// Solves A X = B for sparse symmetric positive definite matrices A of one pattern (CHOLMOD). Results are
/// reproducible: no threads, no BLAS. Allocates only in the first factorize(), and in updates larger than
/// reserved.
class PositiveDefiniteSolver {
 public:
  /// Orders and analyses the pattern. @param lower compressed lower triangle of A.
  explicit PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower);
  ~PositiveDefiniteSolver();

  /// @param lower of the analysed pattern. @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// Allocates the memory for updates by `count` vectors.
  void reserveUpdates(std::size_t count);

  /// Adds v v^T to A for each vector of `added` and subtracts it for each of `removed` (Davis and Hager
  /// 1999). The entries must be in the pattern. @throw std::runtime_error if the result is not positive
  /// definite.
  void update(const std::vector<TetVector>& added, const std::vector<TetVector>& removed);

  /// The factor of the last factorize() or update(), valid until the next.
  CholeskyView factor() const;

  /// X = A^-1 B, both #V by 3.
  void solve(const Points& B, Points* X);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
