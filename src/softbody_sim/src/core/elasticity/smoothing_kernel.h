#pragma once

#include <cstddef>

#include "simd/simd.h"

namespace softbody {

/// SmoothedGradients in the precision T. Patches are padded to whole blocks of 16 by ones without volume.
template <typename T>
struct PatchView {
  std::size_t vertex_count;
  const int* first;          ///< vertex_count + 1, of a patch's entries
  const int* rows;           ///< per entry: where the row of its vertex begins, four times the vertex
  const T* gradients;        ///< per entry: three numbers [1/m]
  const T* gradients_there;  ///< per entry: this patch's vertex in the patch of the entry's [1/m]
  std::size_t padded_count;
  const int* columns;  ///< padded_count: where a patch's three columns begin, twelve times the patch
  const T* volumes;    ///< padded_count [m^3]
};

/// Energy [J] of the corotated material over the patches; adds its gradient [N]. @param x, gradient rows of
/// four numbers (x, y, z, 0). @param deformations, stresses room for 12 * padded_count numbers each.
template <typename T>
using SmoothingKernel = double (*)(const PatchView<T>& patches, T mu, T lambda, const T* x, T* deformations,
                                   T* stresses, T* gradient);

template <typename T>
SmoothingKernel<T> smoothingKernel(Simd simd);

}  // namespace softbody
