#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "tets/tet_matrix.h"

namespace softbody {

/// Adjacent columns of a factor that share their rows.
struct Supernode {
  using Values = Eigen::Map<const Eigen::MatrixXd>;

  int first;        ///< column
  const int* rows;  ///< `values.rows()` of them, ascending; the columns' own come first
  Values values;    ///< one column for each of the factor's; those above the diagonal are arbitrary

  int width() const { return static_cast<int>(values.cols()); }
  int below() const { return static_cast<int>(values.rows() - values.cols()); }
};

/// Solves A X = B for sparse symmetric positive definite matrices A of one pattern (CHOLMOD), by
/// A(order, order) = L L^T. Small matrices are factored column by column, which allows cheap updates; the
/// columns of large ones in groups by BLAS, after an order by METIS. Results are reproducible on one machine
/// with one number of BLAS threads.
/// For small matrices, allocates only in the first factorize(), and in updates larger than reserved.
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

  /// #V: row of A at each position of the factor's order.
  const std::vector<int>& order() const;
  int supernodeCount() const;
  /// Of the last factorize() or update(). Valid until the next call.
  Supernode supernode(int index) const;

  /// X = A^-1 B, both #V by 3.
  void solve(const Points& B, Points* X);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
