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
  /// @throw std::invalid_argument if the volume of a rest tet is not positive.
  FemElasticity(const TetTopology& topology, Elasticity elasticity, const Lame& lame);

  /// Energy [J]; adds its gradient [N], #V by 3.
  double addTo(const Points& x, Points* gradient) const;

  /// Adds the Hessian. @param project projects each tet's Hessian onto the positive semidefinite matrices.
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
