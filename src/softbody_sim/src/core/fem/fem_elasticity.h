#pragma once

#include <Eigen/Core>
#include <vector>

#include "elasticity/strain_smoothing.h"
#include "fem/edge_springs.h"
#include "fem/isotropic_energy.h"
#include "softbody_common/geometry/types.h"
#include "tets/block_tet_matrix.h"

namespace softbody {

/// Elastic energy of linear tets with its gradient and Hessian (Kang et al. 2022, section 5.1). A fraction of
/// it uses strains smoothed around the vertices, which reduces locking; springs cannot be smoothed.
class FemElasticity {
 public:
  /// @throw std::invalid_argument if the volume of a rest tet is not positive, or the strains of springs are
  /// smoothed.
  FemElasticity(const TetTopology& topology, Elasticity elasticity, const ElasticMaterials& materials);
  FemElasticity(const TetTopology& topology, Elasticity elasticity, const Lame& lame,
                const Smoothing& smoothing = {})
      : FemElasticity(topology, elasticity, ElasticMaterials(lame, smoothing)) {}

  /// Energy [J]; adds its gradient [N], #V by 3.
  double addTo(const Points& x, Points* gradient) const;

  /// The vertices that the Hessian couples: of each tet, then of each patch of smoothed strains.
  std::vector<Eigen::VectorXi> groups() const;

  /// Adds the Hessian. @param matrix couples groups(); @param project projects the Hessian of each tet and
  /// patch onto the positive semidefinite matrices.
  void addHessian(const Points& x, BlockTetMatrix* matrix, bool project = true) const;

 private:
  /// A tet, or the tets around a vertex.
  struct Element {
    Eigen::VectorXi vertices;
    Eigen::MatrixX3d shape_gradients;  ///< of the vertices' shape functions, averaged over the volume [1/m]
    double volume;                     ///< [m^3]
    Lame lame;
    EdgeSprings springs = {};  ///< only with springs
  };
  /// Energy density [J/m^3] and its derivative by F [Pa].
  struct Density {
    double energy;
    Eigen::Matrix3d stress;
  };
  void addPatches(const TetTopology& topology, const ElasticMaterials& materials);
  Eigen::Matrix3d deformationGradient(const Element& element, const Points& x) const;
  Density density(const Element& element, const Eigen::Matrix3d& F) const;
  EdgeSprings::Hessian hessian(const Element& element, const Eigen::Matrix3d& F, bool project) const;

  Elasticity elasticity_;
  std::vector<Element> elements_;
};

}  // namespace softbody
