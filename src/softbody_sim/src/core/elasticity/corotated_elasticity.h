#pragma once

#include <Eigen/Core>

#include "elasticity/lame_parameters.h"
#include "elasticity/strain_smoothing.h"
#include "softbody_common/geometry/types.h"
#include "tets/tet_matrix.h"

namespace softbody {

/// Energy density [J/m^3] of the corotated material, mu |F - R|^2 + lambda/2 tr^2(R^T F - I), and its
/// derivative with respect to F. The second term equals the projective-dynamics distance 3/2 lambda |F - T|^2
/// to the nearest T whose singular values sum to 3. Finite for every finite F, also for inverted ones.
double corotatedEnergy(const Eigen::Matrix3d& F, const Lame& lame, Eigen::Matrix3d* stress);

/// Elastic energy of linear tets. A fraction of it uses strains smoothed around the vertices, which reduces
/// locking.
class CorotatedElasticity {
 public:
  /// @throw std::invalid_argument if the volume of a rest tet is not positive.
  CorotatedElasticity(const Points& rest_vertices, const Tets& tets, ElasticMaterials materials);
  CorotatedElasticity(const Points& rest_vertices, const Tets& tets, const Lame& lame,
                      const Smoothing& smoothing = {})
      : CorotatedElasticity(rest_vertices, tets, ElasticMaterials(lame, smoothing)) {}

  /// Energy [J]; adds its gradient [N], #V by 3.
  double addTo(const Points& x, Points* gradient) const;

  /// Adds the constant metric sum_t k_t G_t^T G_t, an upper bound of the energy's curvature near rest. It
  /// also bounds the smoothed energy: the square of a mean is at most the mean of the squares.
  void addMetric(TetMatrix* matrix) const;

  const Eigen::Matrix<int, Eigen::Dynamic, 4>& tets() const { return tets_; }
  const Eigen::VectorXd& volumes() const { return volumes_; }  ///< [m^3]
  Lame tetLame(Eigen::Index t) const { return tetPart(materials_.of(t)); }
  Lame patchLame(Eigen::Index p) const {
    return patchPart(
        materials_.kinds[static_cast<std::size_t>(smoothed_.kinds[static_cast<std::size_t>(p)])]);
  }
  const SmoothedGradients& smoothed() const { return smoothed_; }  ///< empty without smoothing

 private:
  Eigen::Matrix3d inverseEdges(Eigen::Index t) const;
  double addTets(const Points& x, Points* gradient) const;
  double addSmoothed(const Points& x, Points* gradient) const;

  Eigen::Matrix<int, Eigen::Dynamic, 4> tets_;
  Eigen::Matrix<double, Eigen::Dynamic, 9>
      inverse_edges_;  ///< of the rest edge matrices, column by column [1/m]
  Eigen::VectorXd volumes_;
  ElasticMaterials materials_;
  SmoothedGradients smoothed_;
};

}  // namespace softbody
