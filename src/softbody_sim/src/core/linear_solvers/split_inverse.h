#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "linear_solvers/dissection.h"
#include "linear_solvers/factor_kernels.h"
#include "simd/rows.h"

namespace softbody {

/// Inverse of a small symmetric positive definite A in three dense blocks. A few vertices S separate the
/// others into P and Q. The blocks then hold less than two thirds of the numbers of A^-1. A solve computes
/// x_S = (A^-1)_S b first, then each part separately: x_P = A_PP^-1 (b_P - A_PS x_S), and Q likewise.
template <typename T>
class SplitInverse {
 public:
  /// @param lower compressed lower triangle of A, for its pattern.
  SplitInverse(const Eigen::SparseMatrix<double>& lower, Simd simd);

  /// Row and column of a vertex in inverse().
  int placeOf(int vertex) const { return places_[static_cast<std::size_t>(vertex)]; }
  /// A^-1, both triangles; fill it before split().
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>& inverse() { return inverse_; }
  /// Computes the blocks. @return false if a part is not positive definite, within rounding.
  bool split();

  /// X = A^-1 B, both paddedRows(#V).
  void multiply(const Rows<T>& B, Rows<T>* X);

 private:
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  struct alignas(32) Lanes {
    T lane[8];
  };
  /// A dense matrix with columns padded to whole Lanes.
  struct Block {
    int rows, columns, lanes;  ///< `lanes` per column
    std::vector<Lanes> values;
    Block(int row_count, int column_count);
    template <typename Values>
    void set(int first_column, const Values& block);
  };

  void splitPart(int begin, int first_own_column, int first_separator_column, Block* part);
  void multiply(const Block& block, int first_row, int result_row);

  Dissection dissection_;
  std::vector<int> places_, result_rows_;  ///< per vertex
  DenseProduct<T> product_;
  Block separator_, first_, second_;
  Matrix inverse_, coupling_;
  Eigen::LLT<Matrix> separator_factor_;
  Rows<T> gathered_, results_;
};

}  // namespace softbody
