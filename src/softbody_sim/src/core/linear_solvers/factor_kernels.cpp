#include "linear_solvers/factor_kernels.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "linear_solvers/factor_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "simd/single_row-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

/// Vectors of rows; one unit of PanelFactor is kParts of them.
template <typename T>
using RowVector = hn::CappedTag<T, 32 / sizeof(T)>;
template <typename T>
constexpr int kLanes = static_cast<int>(hn::MaxLanes(RowVector<T>()));
template <typename T>
constexpr int kParts = PanelFactor<T>::kUnit / kLanes<T>;
template <typename T>
using Three = hn::Vec<RowVector<T>>[3];

template <typename T>
HWY_INLINE hn::Vec<RowVector<T>> loadValues(const T* values) {
  return hn::Load(RowVector<T>(), values);
}
HWY_INLINE hn::Vec<RowVector<float>> loadValues(const std::uint16_t* values) {
  const RowVector<float> d;
  const hn::Rebind<std::uint16_t, decltype(d)> bits;
  const hn::Rebind<hwy::float16_t, decltype(d)> half;
  return hn::PromoteTo(d, hn::BitCast(half, hn::Load(bits, values)));
}

/// The sum of rows (x, y, z, 0), given as three vectors.
template <typename T>
HWY_INLINE Row<T> sumOfRows(const Three<T>& xyz) {
  const RowVector<T> d;
  alignas(32) T rows[4 * kLanes<T>];
  hn::StoreInterleaved4(xyz[0], xyz[1], xyz[2], hn::Zero(d), d, rows);
  Row<T> sums[2] = {Row<T>::load(rows), Row<T>::load(rows + 4)};
  for (int k = 2; k < kLanes<T>; ++k) sums[k % 2] = sums[k % 2].plus(Row<T>::load(rows + 4 * k));
  return sums[0].plus(sums[1]);
}

/// x := A b for a strip A of kUnits units. @return the end of A.
template <int kUnits, typename T, typename Stored>
HWY_INLINE const Stored* multiplyStrip(const Stored* A, int columns, const T* b, T* x) {
  const RowVector<T> d;
  constexpr int kVectors = kUnits * kParts<T>;
  Three<T> sums[kVectors];
  for (auto& sum : sums) sum[0] = sum[1] = sum[2] = hn::Zero(d);
  for (int c = 0; c < columns; ++c, b += 4) {
    const auto bx = hn::Set(d, b[0]), by = hn::Set(d, b[1]), bz = hn::Set(d, b[2]);
    for (int k = 0; k < kVectors; ++k, A += kLanes<T>) {
      const auto a = loadValues(A);
      sums[k][0] = hn::MulAdd(a, bx, sums[k][0]);
      sums[k][1] = hn::MulAdd(a, by, sums[k][1]);
      sums[k][2] = hn::MulAdd(a, bz, sums[k][2]);
    }
  }
  for (int k = 0; k < kVectors; ++k)
    hn::StoreInterleaved4(sums[k][0], sums[k][1], sums[k][2], hn::Zero(d), d, x + 4 * k * kLanes<T>);
  return A;
}

/// sums += A^T b, where each column's sum is three vectors, whose lanes add up. @return the end of A.
template <int kUnits, typename T, typename Stored>
HWY_INLINE const Stored* multiplyTransposed(const Stored* A, int columns, const T* b, T* sums) {
  const RowVector<T> d;
  constexpr int kVectors = kUnits * kParts<T>;
  Three<T> rows[kVectors];
  hn::Vec<RowVector<T>> unused;
  for (int k = 0; k < kVectors; ++k)
    hn::LoadInterleaved4(d, b + 4 * k * kLanes<T>, rows[k][0], rows[k][1], rows[k][2], unused);
  for (int c = 0; c < columns; ++c, sums += 3 * kLanes<T>) {
    Three<T> sum;
    for (int axis = 0; axis < 3; ++axis) sum[axis] = hn::LoadU(d, sums + axis * kLanes<T>);
    for (int k = 0; k < kVectors; ++k, A += kLanes<T>) {
      const auto a = loadValues(A);
      for (int axis = 0; axis < 3; ++axis) sum[axis] = hn::MulAdd(a, rows[k][axis], sum[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) hn::StoreU(sum[axis], d, sums + axis * kLanes<T>);
  }
  return A;
}

/// Calls `strip(units, first row, columns)` for the strips of a block.
template <typename T, typename Strip>
HWY_INLINE void forEachStrip(int rows, int columns, bool is_triangle, const Strip& strip) {
  constexpr int kUnit = PanelFactor<T>::kUnit, kStrip = PanelFactor<T>::kStrip;
  const auto columnsTo = [&](int end) { return is_triangle && end < columns ? end : columns; };
  int row = 0;
  for (; row + (kStrip - 1) * kUnit < rows; row += kStrip * kUnit)
    strip(std::integral_constant<int, 3>(), row, columnsTo(row + 3 * kUnit));
  if (row + kUnit < rows)
    strip(std::integral_constant<int, 2>(), row, columnsTo(row + 2 * kUnit));
  else if (row < rows)
    strip(std::integral_constant<int, 1>(), row, columnsTo(row + kUnit));
}

template <typename T, typename Stored>
HWY_INLINE void forward(const PanelFactor<T>& factor, const typename PanelFactor<T>::Panel& panel,
                        const Stored* values, T* scratch, T* y) {
  const Stored* A = values + panel.triangle_begin;
  T* own = y + 4 * panel.first_column;
  T* solved = scratch;
  forEachStrip<T>(panel.width, panel.width, true, [&](auto units, int row, int columns) {
    A = multiplyStrip<decltype(units)::value>(A, columns, own, solved + 4 * row);
  });
  for (int c = 0; c < panel.width; ++c) Row<T>::load(solved + 4 * c).store(own + 4 * c);
  A = values + panel.below_begin;
  const int* rows = factor.rows() + panel.row_begin;
  forEachStrip<T>(panel.row_count, panel.width, false, [&](auto units, int row, int columns) {
    A = multiplyStrip<decltype(units)::value>(A, columns, own, scratch);
    const int end = std::min(panel.row_count - row, decltype(units)::value * PanelFactor<T>::kUnit);
    for (int k = 0; k < end; ++k) {
      T* target = y + 4 * rows[row + k];
      Row<T>::load(target).minus(Row<T>::load(scratch + 4 * k)).store(target);
    }
  });
}

template <typename T, typename Stored>
HWY_INLINE void backward(const PanelFactor<T>& factor, const typename PanelFactor<T>::Panel& panel,
                         const Stored* values, T* scratch, T* y) {
  constexpr int kSum = 3 * kLanes<T>;
  T *own = y + 4 * panel.first_column, *gathered = scratch, *sums = scratch + 4 * factor.largest();
  const RowVector<T> d;
  const auto clear = [&] {
    for (int k = 0; k < panel.width * kSum; k += kLanes<T>) hn::StoreU(hn::Zero(d), d, sums + k);
  };
  clear();
  const Stored* A = values + panel.below_begin;
  const int* rows = factor.rows() + panel.row_begin;
  forEachStrip<T>(panel.row_count, panel.width, false, [&](auto units, int row, int columns) {
    constexpr int kRows = decltype(units)::value * PanelFactor<T>::kUnit;
    const int end = std::min(panel.row_count - row, kRows);
    for (int k = 0; k < end; ++k) Row<T>::load(y + 4 * rows[row + k]).store(gathered + 4 * k);
    for (int k = end; k < kRows; ++k) Row<T>::zero().store(gathered + 4 * k);
    A = multiplyTransposed<decltype(units)::value>(A, columns, gathered, sums);
  });
  const auto sum = [&](int c) {
    Three<T> xyz;
    for (int axis = 0; axis < 3; ++axis) xyz[axis] = hn::LoadU(d, sums + c * kSum + axis * kLanes<T>);
    return sumOfRows<T>(xyz);
  };
  const int padded =
      (panel.width + PanelFactor<T>::kUnit - 1) / PanelFactor<T>::kUnit * PanelFactor<T>::kUnit;
  for (int c = 0; c < panel.width; ++c) Row<T>::load(own + 4 * c).minus(sum(c)).store(gathered + 4 * c);
  for (int c = panel.width; c < padded; ++c) Row<T>::zero().store(gathered + 4 * c);
  clear();
  A = values + panel.triangle_begin;
  forEachStrip<T>(panel.width, panel.width, true, [&](auto units, int row, int columns) {
    A = multiplyTransposed<decltype(units)::value>(A, columns, gathered + 4 * row, sums);
  });
  for (int c = 0; c < panel.width; ++c) sum(c).store(own + 4 * c);
}

template <typename T, typename Stored>
void solvePanels(const PanelFactor<T>& factor, const Stored* values, T* scratch, T* y) {
  const auto& panels = factor.panels();
  for (const auto& panel : panels) forward(factor, panel, values, scratch, y);
  for (auto panel = panels.rbegin(); panel != panels.rend(); ++panel)
    backward(factor, *panel, values, scratch, y);
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

void solveFloat(const PanelFactor<float>& factor, float* scratch, float* y) {
  if (factor.halves() != nullptr)
    solvePanels(factor, factor.halves(), scratch, y);
  else
    solvePanels(factor, factor.values(), scratch, y);
}
void solveDouble(const PanelFactor<double>& factor, double* scratch, double* y) {
  solvePanels(factor, factor.values(), scratch, y);
}
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
