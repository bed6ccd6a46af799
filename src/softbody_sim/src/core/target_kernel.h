#pragma once

#include <cstddef>

#include "core/simd.h"

namespace softbody {

/// A target as TargetEnergy has it, in rows (x, y, z, 0).
template <typename T>
struct TargetRow {
  int vertices[4];
  T barycentric[4];
  T position[4];
  T normal[4];  ///< unit, or zero
  T stiffness;
  bool has_normal;
  bool one_sided;  ///< pushes along the normal only
};

/// Energy [J] of targets; adds its gradient [N].
template <typename T>
using TargetKernel = double (*)(const TargetRow<T>* targets, std::size_t count, const T* x, T* gradient);

template <typename T>
TargetKernel<T> targetKernel(Simd simd);

}  // namespace softbody
