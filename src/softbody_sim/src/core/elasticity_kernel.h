#pragma once

#include <cstddef>

#include "core/simd.h"

namespace softbody {

/// Tets in blocks of 16, each number of a block in 16 neighbouring lanes, whatever the vector width.
template <typename T>
struct alignas(64) TetBlock {
  static constexpr int kLanes = 16;
  T inverse_edges[9][kLanes];  ///< of the rest edge matrices, column by column [1/m]
  T volume[kLanes];            ///< [m^3]; 0: a lane that only fills the block
  int vertices[4][kLanes];
};

/// Energy [J] of the corotated material over `count` blocks; adds its gradient [N]. @param x, gradient rows
/// of four numbers (x, y, z, 0).
template <typename T>
using ElasticityKernel = double (*)(const TetBlock<T>* blocks, std::size_t count, T mu, T lambda, const T* x,
                                    T* gradient);

template <typename T>
ElasticityKernel<T> elasticityKernel(Simd simd);

}  // namespace softbody
