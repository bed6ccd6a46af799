#pragma once

#include <Eigen/Core>
#include <vector>

#include "elasticity/isotropic_energy.h"
#include "softbody_common/types.h"
#include "tets/block_tet_matrix.h"

namespace softbody {

/// Elastic energy of linear tets with its gradient and Hessian (Kang et al. 2022, section 5.1).
class FemElasticity {
 public:
  /// @throw std::invalid_argument if a rest tet has no positive volume.
  FemElasticity(const TetTopology& topology, Elasticity elasticity, const Lame& lame);

  /// Energy [J]; adds its gradient [N], #V by 3.
  double addTo(const Points& x, Points* gradient) const;

  /// Adds the Hessian, each tet's projected onto the positive semidefinite matrices unless told otherwise.
  void addHessian(const Points& x, BlockTetMatrix* matrix, bool project = true) const;

 private:
  struct Element {
    Eigen::Vector4i vertices;
    Eigen::Matrix<double, 4, 3> shape_gradients;  ///< of the four shape functions [1/m]
    double volume;                                ///< [m^3]
  };
  Eigen::Matrix3d deformationGradient(const Element& element, const Points& x) const;

  Elasticity elasticity_;
  Lame lame_;
  std::vector<Element> elements_;
};

}  // namespace softbody
