#pragma once

#include <cstddef>

#include "simd/simd.h"

namespace softbody {

/// A block of 16 tets. Each quantity lies in 16 adjacent lanes, for every vector width.
template <typename T>
struct alignas(64) TetBlock {
  static constexpr int kLanes = 16;
  /// Inverse rest edge matrices: (0,0), (0,1), (1,1), (0,2), (1,2), (2,2) [1/m]. Each is rotated to upper
  /// triangular form, which does not change an isotropic energy.
  T inverse_edges[6][kLanes];
  T shear[kLanes];         ///< 2 mu times volume [J]; 0: unused lane
  T bulk[kLanes];          ///< lambda times volume [J]
  int corners[4][kLanes];  ///< offsets of the vertices' rows
};

/// Energy [J] of the corotated material over `count` blocks; adds its gradient [N]. @param x, gradient rows
/// of four numbers (x, y, z, 0).
template <typename T>
using ElasticityKernel = double (*)(const TetBlock<T>* blocks, std::size_t count, const T* x, T* gradient);

template <typename T>
ElasticityKernel<T> elasticityKernel(Simd simd);

}  // namespace softbody
