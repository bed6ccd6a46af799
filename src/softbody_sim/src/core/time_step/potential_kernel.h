#pragma once

#include <cstddef>

#include "simd/simd.h"

namespace softbody {

/// A spring of TargetEnergy in rows (x, y, z, 0).
template <typename T>
struct TargetRow {
  int corners[4];  ///< offsets of the vertices' rows
  T barycentric[4];
  T position[4];
  T normal[4];  ///< unit, or zero
  T stiffness;
  bool has_normal;
  T slide;         ///< of friction: as TargetEnergy::Spring::slide_m
  bool one_sided;  ///< only pushes along the normal
  bool is_friction;
  bool is_coupled;  ///< the position is relative to a second point, which gets the opposite force
  int other_corners[4];
  T other_barycentric[4];
};

/// View of an IncrementalPotential in rows (x, y, z, 0).
template <typename T>
struct PotentialView {
  std::size_t size;  ///< numbers in all rows, a multiple of 64
  const T *inertia, *prediction, *loads;
  const TargetRow<T>* targets;
  std::size_t target_count;
};

/// Energy [J]; sets its gradient [N].
template <typename T>
using PotentialKernel = double (*)(const PotentialView<T>& step, const T* x, T* gradient);

template <typename T>
PotentialKernel<T> potentialKernel(Simd simd);

}  // namespace softbody
