#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstring>

namespace softbody {

/// Vertices for the vector kernels: one row (x, y, z, 0) per vertex, so that a vertex is one vector load.
template <typename T>
using Rows = Eigen::Matrix<T, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Rows to allocate for a number of vertices; kernels write whole vectors of rows.
inline Eigen::Index paddedRows(Eigen::Index vertex_count) { return (vertex_count + 15) / 16 * 16; }

/// Row k of `to` = row places[k] of `from`.
template <typename T>
void gatherRows(const T* from, const int* places, std::size_t count, T* to) {
  for (std::size_t k = 0; k < count; ++k) std::memcpy(to + 4 * k, from + 4 * places[k], 4 * sizeof(T));
}

/// Row places[k] of `to` = row k of `from`.
template <typename T>
void scatterRows(const T* from, const int* places, std::size_t count, T* to) {
  for (std::size_t k = 0; k < count; ++k) std::memcpy(to + 4 * places[k], from + 4 * k, 4 * sizeof(T));
}

}  // namespace softbody
