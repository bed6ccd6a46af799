#pragma once

#include <vector>

#include "softbody_virtual_camera/scenes/scene.h"
#include "solid/hex_solid.h"

namespace softbody::virtual_camera {

/// Cells for a body that bends along x. Trilinear cells are too stiff when they bend, by the square of their
/// length there: the sponge of cells of 10 mm is 2.8 % too stiff, of these 1 %.
const Eigen::Vector3d kBendingCell_m(0.005, 0.02, 0.01);
/// Likewise, for many short steps: 1.6 %.
const Eigen::Vector3d kSwingingCell_m(0.0067, 0.02, 0.01);

/// The body's surface in a grid of cells.
class EmbeddedBody {
 public:
  /// @param rest closed. @param elasticity an unknown density is 30 kg/m^3: it does not matter where the
  /// weight is left out. @param cell_m edges of a cell, at most.
  EmbeddedBody(const TriangleMesh& rest, const Elasticity& elasticity,
               const Eigen::Vector3d& cell_m = Eigen::Vector3d::Constant(0.01));

  const HexSolid& solid() const { return solid_; }
  const Points& restNodes() const { return solid_.grid().nodes; }
  TrueMaterial material() const;

  /// The vertices of the surface. @param moved how far each node has moved, #N by 3 [m].
  Points surface(const Points& moved) const;

 private:
  Points rest_;
  Elasticity elasticity_;
  HexSolid solid_;
  std::vector<Embedding> places_;
};

}  // namespace softbody::virtual_camera
