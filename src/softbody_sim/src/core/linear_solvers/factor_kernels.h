#pragma once

#include <vector>

#include "simd/simd.h"

namespace softbody {

/// A Cholesky factor in panels of one, two or four adjacent columns with the same rows below them.
template <typename T>
struct PanelFactor {
  struct Panel {
    int first_column;
    int width;
    int row_begin, row_end;  ///< in `rows`
    int value_begin;         ///< in `values`
    T triangle[4][4];        ///< lower triangle, with reciprocals on the diagonal
  };
  std::vector<Panel> panels;
  std::vector<int> rows;  ///< below the panels' triangles
  std::vector<T> values;  ///< for each of those rows, the values of the panel's columns
};

/// y := L^-T L^-1 y for three right-hand sides; y has rows (x, y, z, 0).
template <typename T>
using PanelSolve = void (*)(const PanelFactor<T>& factor, T* y);
template <typename T>
PanelSolve<T> panelSolve(Simd simd);

/// x := A b. @param A `count` columns, `stride` numbers each, a multiple of 8, aligned to 32 bytes
/// @param b, x rows (x, y, z, 0); b `count` of them, x `stride`.
template <typename T>
using DenseProduct = void (*)(const T* A, int count, int stride, const T* b, T* x);
template <typename T>
DenseProduct<T> denseProduct(Simd simd);

}  // namespace softbody
