#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "solid/cell_grid.h"
#include "solid/stable_neo_hookean.h"

namespace softbody::virtual_camera {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// The elastic energy of a body: trilinear hexahedra with 2 x 2 x 2 Gauss points. Unknown 3 n + a is
/// coordinate a of node n [m].
class HexSolid {
 public:
  HexSolid(CellGrid grid, const StableNeoHookean& material);

  const CellGrid& grid() const { return grid_; }
  Eigen::Index unknowns() const { return 3 * grid_.nodes.rows(); }
  Eigen::VectorXd rest() const;
  /// Of the body around each node [m^3]: times the density, the lumped masses.
  Eigen::VectorXd nodalVolumes() const;

  double energy(const Eigen::VectorXd& nodes) const;                                ///< [J]
  void addGradient(const Eigen::VectorXd& nodes, Eigen::VectorXd* gradient) const;  ///< [N]
  /// Appends the lower triangle of the second derivative [N/m]. @param positive of every Gauss point.
  void addStiffness(const Eigen::VectorXd& nodes, bool positive, Triplets* triplets) const;

 private:
  using Slopes = Eigen::Matrix<double, 3, 8>;  ///< of the corners' weights at a Gauss point [1/m]
  using Corners = Eigen::Matrix<double, 3, 8>;

  Corners cornersOf(const Eigen::VectorXd& nodes, std::size_t cell) const;

  CellGrid grid_;
  StableNeoHookean material_;
  std::array<Slopes, 8> slopes_;
};

/// The points at positions of the nodes, three numbers each.
Points asPoints(const Eigen::VectorXd& nodes);

}  // namespace softbody::virtual_camera
