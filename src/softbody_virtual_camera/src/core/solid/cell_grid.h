#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// A point as a weighted sum of the corners of a cell.
struct Embedding {
  std::array<int, 8> nodes{};
  std::array<double, 8> weights{};  ///< they add up to 1

  /// @param nodes #N by 3
  Eigen::Vector3d in(const Points& nodes) const;
};

/// A regular grid of blocks that covers a body. A block at the surface counts with the part of it that is
/// inside (finite cell method: Parvizian, Duester and Rank 2007), so the surface needs no mesh of its own.
struct CellGrid {
  Points nodes;                           ///< at rest [m]
  std::vector<std::array<int, 8>> cells;  ///< corner 4 a + 2 b + c is at step (a, b, c) along x, y, z
  std::vector<std::array<double, 8>>
      volumes;                ///< of the body around each Gauss point, like the corners [m^3]
  Eigen::Vector3d cell_size;  ///< [m]

  /// A point of the body at rest. Just outside of all cells, the nearest cell is extrapolated.
  Embedding embed(const Eigen::Vector3d& rest) const;
};

/// @param body closed. @param size_m edges of a block, at most.
CellGrid fillWithCells(const TriangleMesh& body, const Eigen::Vector3d& size_m);
CellGrid fillWithCells(const TriangleMesh& body, double size_m);  ///< the same along all axes

/// Values of the eight corners of a cell at a place in it: 0 to 1 along each axis.
std::array<double, 8> cornerWeights(const Eigen::Vector3d& place);

}  // namespace softbody::virtual_camera
