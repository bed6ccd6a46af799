#pragma once

#include <Eigen/Core>

namespace softbody {

/// Dense matrices with some hundred columns, and their products in the widest vectors of this processor.
/// Those of Eigen have the vectors that every processor has.
template <typename T>
using DenseRows = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Columns for whole vectors: at least this many, the last ones 0.
constexpr Eigen::Index paddedColumns(Eigen::Index columns) { return (columns + 15) / 16 * 16; }

/// A^T B, if that is symmetric. @param A, @param B any number of rows by paddedColumns(#columns).
/// @return #columns by #columns.
Eigen::MatrixXd symmetricProduct(const DenseRows<double>& A, const DenseRows<double>& B,
                                 Eigen::Index columns);

/// The squared norm of each row of A W, #rows. @param W #columns of A by paddedColumns().
Eigen::VectorXf squaredRowNorms(const DenseRows<float>& A, const DenseRows<float>& W);

/// The inverse of the root of a positive definite matrix: W with W^T W its inverse, lower triangular.
/// @param positive only its lower triangle counts. @return #columns by paddedColumns(#columns).
/// @throw std::runtime_error if the matrix is not positive definite.
DenseRows<double> inverseRoot(const Eigen::MatrixXd& positive);

/// The inverse of a positive definite matrix. @throw as inverseRoot does.
inline Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& positive) {
  const DenseRows<double> root = inverseRoot(positive);
  return symmetricProduct(root, root, positive.cols());
}

}  // namespace softbody
