#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "simd/rows.h"

namespace softbody {

/// Cholesky factor of a symmetric 3 #V by 3 #V matrix in dense panels, in single precision, for use as a
/// metric: a solve costs little, and its rounding does not matter.
class HessianFactor {
 public:
  /// @param lower compressed lower triangle, for its pattern.
  explicit HessianFactor(const Eigen::SparseMatrix<double>& lower);
  ~HessianFactor();

  /// @return false if the matrix is not positive definite; then there is no factor.
  bool factorize(const Eigen::SparseMatrix<double>& lower);

  /// X = A^-1 B for rows (x, y, z, 0); paddedRows(#V).
  void solve(const Rows<double>& B, Rows<double>* X);

 private:
  /// Adjacent columns with the same rows below them.
  struct Panel {
    int first, width, row_begin, row_count;
    std::size_t value_begin;  ///< of a column-major matrix: the triangle, then the rows below
  };
  class Cholmod;

  void readPanels();

  std::unique_ptr<Cholmod> cholmod_;
  std::vector<Panel> panels_;
  std::vector<int> rows_, order_;
  std::vector<float> values_;
  Eigen::VectorXf y_, gathered_;
};

}  // namespace softbody
