#include "elasticity/corotated_elasticity.h"

#include <Eigen/LU>

#include "elasticity/rotation.h"
#include "tets/tet_shape.h"

namespace softbody {

double corotatedEnergy(const Eigen::Matrix3d& F, const Lame& lame, Eigen::Matrix3d* stress) {
  Eigen::Matrix3d R;
  const double dilation = extractRotation(F, &R) - 3.0;
  const Eigen::Matrix3d strain = F - R;
  *stress = 2.0 * lame.mu * strain + (lame.lambda * dilation) * R;
  return lame.mu * strain.squaredNorm() + 0.5 * lame.lambda * dilation * dilation;
}

CorotatedElasticity::CorotatedElasticity(const Points& rest_vertices, const Tets& tets, const Lame& lame,
                                         const Smoothing& smoothing)
    : tets_(tets),
      inverse_edges_(tets.rows(), 9),
      volumes_(positiveVolumes(rest_vertices, tets)),
      lame_(lame),
      tet_share_(softbody::tetShare(lame, smoothing)),
      patch_share_(softbody::patchShare(lame, smoothing)) {
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const Eigen::Matrix3d inverse = edgesOf(rest_vertices, tets.row(t)).inverse();
    inverse_edges_.row(t) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(inverse.data());
  }
  if (patch_share_.volume > 0.0) smoothed_ = smoothedGradients(rest_vertices, tets);
}

Eigen::Matrix3d CorotatedElasticity::inverseEdges(Eigen::Index t) const {
  const Eigen::Matrix<double, 1, 9> columns = inverse_edges_.row(t);
  return Eigen::Map<const Eigen::Matrix3d>(columns.data());
}

double CorotatedElasticity::addTo(const Points& x, Points* gradient) const {
  return addTets(x, gradient) + addSmoothed(x, gradient);
}

double CorotatedElasticity::addTets(const Points& x, Points* gradient) const {
  double energy = 0.0;
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const Eigen::Matrix3d inverse = inverseEdges(t);
    Eigen::Matrix3d stress;
    const double volume = tet_share_.volume * volumes_[t];
    energy += volume * corotatedEnergy(edgesOf(x, tets_.row(t)) * inverse, tet_share_.lame, &stress);
    const Eigen::Matrix3d forces = volume * stress * inverse.transpose();
    for (int k = 0; k < 3; ++k) gradient->row(tets_(t, k + 1)) += forces.col(k).transpose();
    gradient->row(tets_(t, 0)) -= (forces.col(0) + forces.col(1) + forces.col(2)).transpose();
  }
  return energy;
}

double CorotatedElasticity::addSmoothed(const Points& x, Points* gradient) const {
  double energy = 0.0;
  for (Eigen::Index v = 0; v < smoothed_.volumes.size(); ++v) {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero(), stress;
    for (int e = smoothed_.first[v]; e < smoothed_.first[v + 1]; ++e)
      F += x.row(smoothed_.vertices[e]).transpose() * smoothed_.gradients.row(e);
    const double volume = patch_share_.volume * smoothed_.volumes[v];
    energy += volume * corotatedEnergy(F, patch_share_.lame, &stress);
    for (int e = smoothed_.first[v]; e < smoothed_.first[v + 1]; ++e)
      gradient->row(smoothed_.vertices[e]) += volume * smoothed_.gradients.row(e) * stress.transpose();
  }
  return energy;
}

void CorotatedElasticity::addMetric(TetMatrix* matrix) const {
  const double stiffness = 2.0 * lame_.mu + 3.0 * lame_.lambda;
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    Eigen::Matrix<double, 3, 4> G;  // gradients of the shape functions
    G.rightCols<3>() = inverseEdges(t).transpose();
    G.col(0) = -G.rightCols<3>().rowwise().sum();
    matrix->addToTet(static_cast<int>(t), stiffness * volumes_[t] * G.transpose() * G);
  }
}

}  // namespace softbody
