#pragma once

#include <cstddef>

#include "simd/simd.h"

namespace softbody {

/// SmoothedGradients in the precision T, by patches and by vertices. Patches without stiffness pad them to
/// blocks of 16.
template <typename T>
struct PatchView {
  std::size_t count;
  const int* first;    ///< count + 1: first entry of each patch
  const int* rows;     ///< per entry: offset of its vertex's row, four times the vertex
  const T* gradients;  ///< per entry: three numbers [1/m]
  std::size_t padded_count;
  const int* columns;  ///< padded_count: offset of a patch's three columns, twelve times the patch
  const T* shear;      ///< padded_count: 2 mu times volume [J]
  const T* bulk;       ///< padded_count: lambda times volume [J]
  std::size_t vertex_count;
  const int* vertex_first;    ///< vertex_count + 1: first entry of each vertex in the next two
  const int* vertex_rows;     ///< per entry: four times the patch
  const T* vertex_gradients;  ///< per entry: three numbers [1/m]
};

/// Energy [J] of the corotated material over the patches; adds its gradient [N]. @param x, gradient rows of
/// four numbers (x, y, z, 0). @param deformations, stresses buffers of 12 * padded_count numbers each.
template <typename T>
using SmoothingKernel = double (*)(const PatchView<T>& patches, const T* x, T* deformations, T* stresses,
                                   T* gradient);

template <typename T>
SmoothingKernel<T> smoothingKernel(Simd simd);

}  // namespace softbody
