#include "linear_solvers/dense_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "linear_solvers/dense_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr Eigen::Index kTile = 4;      // rows of a tile of the result
constexpr Eigen::Index kInCache = 32;  // rows of A that stay in the cache

/// Adds A(:, i : i + kTile)^T B(:, j : j + 2 vectors) to a tile. @param stride of all three.
HWY_INLINE void addTile(const double* A, const double* B, Eigen::Index rows, Eigen::Index stride,
                        double* result) {
  const hn::ScalableTag<double> d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  hn::Vec<decltype(d)> sums[kTile][2];
  for (Eigen::Index r = 0; r < kTile; ++r)
    for (Eigen::Index c = 0; c < 2; ++c) sums[r][c] = hn::LoadU(d, result + r * stride + c * lanes);
  for (Eigen::Index k = 0; k < rows; ++k, A += stride, B += stride) {
    const auto first = hn::LoadU(d, B), second = hn::LoadU(d, B + lanes);
    for (Eigen::Index r = 0; r < kTile; ++r) {
      const auto own = hn::Set(d, A[r]);
      sums[r][0] = hn::MulAdd(own, first, sums[r][0]);
      sums[r][1] = hn::MulAdd(own, second, sums[r][1]);
    }
  }
  for (Eigen::Index r = 0; r < kTile; ++r)
    for (Eigen::Index c = 0; c < 2; ++c) hn::StoreU(sums[r][c], d, result + r * stride + c * lanes);
}

}  // namespace

/// Adds the tiles of A^T B that its lower triangle needs.
void addProduct(const double* A, const double* B, Eigen::Index rows, Eigen::Index stride, double* result) {
  const hn::ScalableTag<double> d;
  const auto width = 2 * static_cast<Eigen::Index>(hn::Lanes(d));
  for (Eigen::Index first = 0; first < rows;
       first += kInCache, A += kInCache * stride, B += kInCache * stride)
    for (Eigen::Index i = 0; i < stride; i += kTile)
      for (Eigen::Index j = 0; j < i + kTile; j += width)
        addTile(A + i, B + j, std::min(kInCache, rows - first), stride, result + i * stride + j);
}

void squareRows(const float* A, Eigen::Index rows, Eigen::Index columns, const float* W, Eigen::Index stride,
                float* squares) {
  const hn::ScalableTag<float> d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  for (Eigen::Index row = 0; row < rows; row += kTile) {
    const float* own[kTile];  // beyond the last row: that row
    for (Eigen::Index r = 0; r < kTile; ++r) own[r] = A + std::min(row + r, rows - 1) * columns;
    hn::Vec<decltype(d)> norms[kTile];
    for (auto& norm : norms) norm = hn::Zero(d);
    for (Eigen::Index j = 0; j < stride; j += lanes) {
      hn::Vec<decltype(d)> sums[kTile];
      for (auto& sum : sums) sum = hn::Zero(d);
      for (Eigen::Index k = 0; k < columns; ++k) {
        const auto w = hn::LoadU(d, W + k * stride + j);
        for (Eigen::Index r = 0; r < kTile; ++r) sums[r] = hn::MulAdd(hn::Set(d, own[r][k]), w, sums[r]);
      }
      for (Eigen::Index r = 0; r < kTile; ++r) norms[r] = hn::MulAdd(sums[r], sums[r], norms[r]);
    }
    for (Eigen::Index r = 0; r < kTile && row + r < rows; ++r)
      squares[row + r] = hn::GetLane(hn::SumOfLanes(d, norms[r]));
  }
}

/// Row i of the inverse is (e_i - sum over k < i of L_ik row k) / L_ii. @param stride of the inverse.
void invertLower(const double* L, Eigen::Index size, Eigen::Index stride, double* inverse) {
  const hn::ScalableTag<double> d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto scale = hn::Set(d, -1.0 / L[i * size + i]);
    for (Eigen::Index j = 0; j <= i; j += lanes) {
      auto sum = hn::Zero(d);
      for (Eigen::Index k = j; k < i; ++k)
        sum = hn::MulAdd(hn::Set(d, L[i * size + k]), hn::LoadU(d, inverse + k * stride + j), sum);
      hn::StoreU(hn::Mul(scale, sum), d, inverse + i * stride + j);
    }
    inverse[i * stride + i] = 1.0 / L[i * size + i];
  }
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace softbody {

HWY_EXPORT(addProduct);
HWY_EXPORT(squareRows);
HWY_EXPORT(invertLower);

Eigen::MatrixXd symmetricProduct(const DenseRows<double>& A, const DenseRows<double>& B,
                                 Eigen::Index columns) {
  DenseRows<double> lower = DenseRows<double>::Zero(A.cols(), A.cols());
  HWY_DYNAMIC_DISPATCH(addProduct)(A.data(), B.data(), A.rows(), A.cols(), lower.data());
  return lower.topLeftCorner(columns, columns).selfadjointView<Eigen::Lower>();
}

Eigen::VectorXf squaredRowNorms(const DenseRows<float>& A, const DenseRows<float>& W) {
  Eigen::VectorXf squares(A.rows());
  HWY_DYNAMIC_DISPATCH(squareRows)(A.data(), A.rows(), A.cols(), W.data(), W.cols(), squares.data());
  return squares;
}

DenseRows<double> inverseRoot(const Eigen::MatrixXd& positive) {
  const Eigen::LLT<Eigen::MatrixXd> factor(positive);
  if (factor.info() != Eigen::Success) throw std::runtime_error("a matrix of the estimate is not positive");
  const DenseRows<double> L = factor.matrixL();
  DenseRows<double> inverse = DenseRows<double>::Zero(L.rows(), paddedColumns(L.cols()));
  HWY_DYNAMIC_DISPATCH(invertLower)(L.data(), L.rows(), inverse.cols(), inverse.data());
  return inverse;
}

}  // namespace softbody

#endif
