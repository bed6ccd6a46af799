#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdlib>

#include "linear_solvers/dense_kernels.h"

namespace softbody {
namespace {

constexpr Eigen::Index kSizes[] = {1, 2, 7, 16, 17, 86, 133};  // around the widths of vectors and tiles

/// With columns of zeros.
template <typename T>
DenseRows<T> padded(const DenseRows<T>& matrix) {
  DenseRows<T> result = DenseRows<T>::Zero(matrix.rows(), paddedColumns(matrix.cols()));
  result.leftCols(matrix.cols()) = matrix;
  return result;
}

TEST(DenseKernels, SymmetricProductIsThatOfEigen) {
  std::srand(1);
  for (const Eigen::Index columns : kSizes) {
    for (const Eigen::Index rows : {Eigen::Index{0}, Eigen::Index{1}, Eigen::Index{31}, Eigen::Index{70}}) {
      const Eigen::VectorXd factors = Eigen::VectorXd::Random(rows);
      const DenseRows<double> A = DenseRows<double>::Random(rows, columns), B = factors.asDiagonal() * A;
      Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(columns, columns);
      if (rows > 0) expected = A.transpose() * B;
      EXPECT_LT((symmetricProduct(padded(A), padded(B), columns) - expected).cwiseAbs().maxCoeff(), 1e-12)
          << rows << " by " << columns;
    }
  }
}

TEST(DenseKernels, RowNormsAreThoseOfEigen) {
  std::srand(3);
  for (const Eigen::Index columns : kSizes) {
    for (const Eigen::Index rows : kSizes) {
      const DenseRows<float> A = DenseRows<float>::Random(rows, columns),
                             W = DenseRows<float>::Random(columns, rows);
      const Eigen::VectorXf expected = (A * W).rowwise().squaredNorm();
      EXPECT_LT((squaredRowNorms(A, padded(W)) - expected).cwiseAbs().maxCoeff(),
                1e-5f * expected.maxCoeff());
    }
  }
}

TEST(DenseKernels, InverseTimesMatrixIsOne) {
  std::srand(4);
  for (const Eigen::Index size : kSizes) {
    const Eigen::MatrixXd half = Eigen::MatrixXd::Random(size, size);
    const Eigen::MatrixXd positive = half * half.transpose() + Eigen::MatrixXd::Identity(size, size);
    EXPECT_LT((inverseOf(positive) * positive - Eigen::MatrixXd::Identity(size, size)).cwiseAbs().maxCoeff(),
              1e-10);
  }
}

}  // namespace
}  // namespace softbody
