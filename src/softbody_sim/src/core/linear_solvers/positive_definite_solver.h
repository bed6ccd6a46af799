#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "softbody_common/types.h"
#include "tets/tet_matrix.h"

namespace softbody {

/// Borrowed view of a factor: A(order, order) = L D L^T, L with a diagonal of ones. Each column of L has its
/// rows ascending, with D in the place of the diagonal.
struct CholeskyView {
  int count;
  const int* order;       ///< #V
  const int* starts;      ///< per column, in rows and values
  const int* row_counts;  ///< per column
  const int* rows;
  const double* values;
};

/// Solves A X = B for sparse symmetric positive definite matrices A of one pattern (CHOLMOD). The same on
/// every run: no threads, no BLAS. Allocates on the first factorize() only, and where an update is wider than
/// reserved.
class PositiveDefiniteSolver {
 public:
  /// Orders and analyses the pattern, once. @param lower compressed lower triangle of A.
  explicit PositiveDefiniteSolver(const Eigen::SparseMatrix<double>& lower);
  ~PositiveDefiniteSolver();

  /// @param lower of the analysed pattern. @throw std::runtime_error if A is not positive definite.
  void factorize(const Eigen::SparseMatrix<double>& lower);

  /// For updates by so many vectors.
  void reserveUpdates(std::size_t count);

  /// Makes it the factor of A plus the sum of v v^T over `added`, minus that over `removed`, whose entries
  /// the pattern must hold (Davis and Hager 1999). @throw std::runtime_error if that is not positive
  /// definite.
  void update(const std::vector<TetVector>& added, const std::vector<TetVector>& removed);

  /// Of the last factorize() or update(), until the next.
  CholeskyView factor() const;

  /// X = A^-1 B, both #V by 3.
  void solve(const Points& B, Points* X);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
