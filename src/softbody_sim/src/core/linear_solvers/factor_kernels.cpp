#include "linear_solvers/factor_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "linear_solvers/factor_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "simd/single_row-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

template <typename T, int kWidth>
HWY_INLINE void forward(const PanelFactor<T>& factor, const typename PanelFactor<T>::Panel& panel, T* y) {
  Row<T> columns[kWidth];
  for (int c = 0; c < kWidth; ++c) columns[c] = Row<T>::load(y + 4 * (panel.first_column + c));
  for (int c = 0; c < kWidth; ++c) {
    columns[c] = columns[c].times(panel.triangle[c][c]);
    for (int r = c + 1; r < kWidth; ++r)
      columns[r] = columns[r].minusProduct(panel.triangle[r][c], columns[c]);
    columns[c].store(y + 4 * (panel.first_column + c));
  }
  const T* values = factor.values.data() + panel.value_begin;
  for (int k = panel.row_begin; k < panel.row_end; ++k, values += kWidth) {
    T* target = y + 4 * factor.rows[k];
    Row<T> row = Row<T>::load(target);
    for (int c = 0; c < kWidth; ++c) row = row.minusProduct(values[c], columns[c]);
    row.store(target);
  }
}

template <typename T, int kWidth>
HWY_INLINE void backward(const PanelFactor<T>& factor, const typename PanelFactor<T>::Panel& panel, T* y) {
  Row<T> columns[kWidth];
  for (int c = 0; c < kWidth; ++c) columns[c] = Row<T>::load(y + 4 * (panel.first_column + c));
  const T* values = factor.values.data() + panel.value_begin;
  for (int k = panel.row_begin; k < panel.row_end; ++k, values += kWidth) {
    const Row<T> row = Row<T>::load(y + 4 * factor.rows[k]);
    for (int c = 0; c < kWidth; ++c) columns[c] = columns[c].minusProduct(values[c], row);
  }
  for (int c = kWidth - 1; c >= 0; --c) {
    for (int r = c + 1; r < kWidth; ++r)
      columns[c] = columns[c].minusProduct(panel.triangle[r][c], columns[r]);
    columns[c] = columns[c].times(panel.triangle[c][c]);
    columns[c].store(y + 4 * (panel.first_column + c));
  }
}

template <typename T>
void solvePanels(const PanelFactor<T>& factor, T* y) {
  for (const auto& panel : factor.panels) {
    if (panel.width == 4)
      forward<T, 4>(factor, panel, y);
    else if (panel.width == 2)
      forward<T, 2>(factor, panel, y);
    else
      forward<T, 1>(factor, panel, y);
  }
  for (auto panel = factor.panels.rbegin(); panel != factor.panels.rend(); ++panel) {
    if (panel->width == 4)
      backward<T, 4>(factor, *panel, y);
    else if (panel->width == 2)
      backward<T, 2>(factor, *panel, y);
    else
      backward<T, 1>(factor, *panel, y);
  }
}

/// Computes kVectors vectors of result rows.
template <int kVectors, class D, typename T = hn::TFromD<D>>
HWY_INLINE void multiplyRows(D d, const T* A, int count, int stride, const T* b, T* x) {
  using V = hn::Vec<D>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  V sums[kVectors][3];
  for (auto& sum : sums) sum[0] = sum[1] = sum[2] = hn::Zero(d);
  for (int j = 0; j < count; ++j, A += stride, b += 4) {
    const V bx = hn::Set(d, b[0]), by = hn::Set(d, b[1]), bz = hn::Set(d, b[2]);
    for (int k = 0; k < kVectors; ++k) {
      const V a = hn::Load(d, A + k * lanes);
      sums[k][0] = hn::MulAdd(a, bx, sums[k][0]);
      sums[k][1] = hn::MulAdd(a, by, sums[k][1]);
      sums[k][2] = hn::MulAdd(a, bz, sums[k][2]);
    }
  }
  for (int k = 0; k < kVectors; ++k) {
    hn::StoreInterleaved4(sums[k][0], sums[k][1], sums[k][2], hn::Zero(d), d, x + 4 * k * lanes);
  }
}

template <typename T>
void multiply(const T* A, int count, int stride, const T* b, T* x) {
  // Wider vectors do not help: memory bandwidth for A is the limit, and nine vectors of sums fill the
  // registers.
  const hn::CappedTag<T, 32 / sizeof(T)> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int row = 0;
  for (; row + 3 * lanes <= stride; row += 3 * lanes)
    multiplyRows<3>(d, A + row, count, stride, b, x + 4 * row);
  for (; row + 2 * lanes <= stride; row += 2 * lanes)
    multiplyRows<2>(d, A + row, count, stride, b, x + 4 * row);
  for (; row < stride; row += lanes) multiplyRows<1>(d, A + row, count, stride, b, x + 4 * row);
}

}  // namespace

void solveFloat(const PanelFactor<float>& factor, float* y) { solvePanels(factor, y); }
void solveDouble(const PanelFactor<double>& factor, double* y) { solvePanels(factor, y); }
void multiplyFloat(const float* A, int count, int stride, const float* b, float* x) {
  multiply(A, count, stride, b, x);
}
void multiplyDouble(const double* A, int count, int stride, const double* b, double* x) {
  multiply(A, count, stride, b, x);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/simd_dispatch.h"

namespace softbody {

HWY_EXPORT(solveFloat);
HWY_EXPORT(solveDouble);
HWY_EXPORT(multiplyFloat);
HWY_EXPORT(multiplyDouble);

template <>
PanelSolve<float> panelSolve<float>(Simd simd) {
  return HWY_DISPATCH_TABLE(solveFloat)[dispatchIndex(simd)];
}
template <>
PanelSolve<double> panelSolve<double>(Simd simd) {
  return HWY_DISPATCH_TABLE(solveDouble)[dispatchIndex(simd)];
}
template <>
DenseProduct<float> denseProduct<float>(Simd simd) {
  return HWY_DISPATCH_TABLE(multiplyFloat)[dispatchIndex(simd)];
}
template <>
DenseProduct<double> denseProduct<double>(Simd simd) {
  return HWY_DISPATCH_TABLE(multiplyDouble)[dispatchIndex(simd)];
}

}  // namespace softbody
#endif
