#pragma once

#include "linear_solvers/panel_factor.h"
#include "simd/simd.h"

namespace softbody {

/// y := L^-T L^-1 y for three right-hand sides; y has rows (x, y, z, 0). @param scratch
/// 28 * factor.largest() numbers.
template <typename T>
using PanelSolve = void (*)(const PanelFactor<T>& factor, T* scratch, T* y);
template <typename T>
PanelSolve<T> panelSolve(Simd simd);

/// x := A b. @param A `count` columns, `stride` numbers each, a multiple of 8, aligned to 32 bytes
/// @param b, x rows (x, y, z, 0); b `count` of them, x `stride`.
template <typename T>
using DenseProduct = void (*)(const T* A, int count, int stride, const T* b, T* x);
template <typename T>
DenseProduct<T> denseProduct(Simd simd);

}  // namespace softbody
