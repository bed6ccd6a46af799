#pragma once

#include <cstddef>

#include "simd/simd.h"

namespace softbody {

/// Tets in blocks of 16, each number of a block in 16 neighbouring lanes, whatever the vector width.
template <typename T>
struct alignas(64) TetBlock {
  static constexpr int kLanes = 16;
  /// Of the rest edge matrices, each turned until it is upper triangular, which an isotropic energy does not
  /// notice: (0,0), (0,1), (1,1), (0,2), (1,2), (2,2) [1/m].
  T inverse_edges[6][kLanes];
  T volume[kLanes];        ///< [m^3]; 0: a lane that only fills the block
  int corners[4][kLanes];  ///< where the vertices' rows begin
};

/// Energy [J] of the corotated material over `count` blocks; adds its gradient [N]. @param x, gradient rows
/// of four numbers (x, y, z, 0).
template <typename T>
using ElasticityKernel = double (*)(const TetBlock<T>* blocks, std::size_t count, T mu, T lambda, const T* x,
                                    T* gradient);

template <typename T>
ElasticityKernel<T> elasticityKernel(Simd simd);

}  // namespace softbody
