#pragma once

#include <Eigen/Core>

namespace softbody {

/// Vertices as the inner solver holds them: a row (x, y, z, 0) a vertex, so that a vertex is one vector load.
template <typename T>
using Rows = Eigen::Matrix<T, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Rows to allocate for a number of vertices: kernels write whole vectors of them.
inline Eigen::Index paddedRows(Eigen::Index vertex_count) { return (vertex_count + 15) / 16 * 16; }

}  // namespace softbody
