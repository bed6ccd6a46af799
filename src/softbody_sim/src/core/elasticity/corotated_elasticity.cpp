#include "elasticity/corotated_elasticity.h"

#include <Eigen/LU>
#include <utility>

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

CorotatedElasticity::CorotatedElasticity(const Points& rest_vertices, const Tets& tets,
                                         ElasticMaterials materials)
    : tets_(tets),
      inverse_edges_(tets.rows(), 9),
      volumes_(positiveVolumes(rest_vertices, tets)),
      materials_(std::move(materials)) {
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const Eigen::Matrix3d inverse = edgesOf(rest_vertices, tets.row(t)).inverse();
    inverse_edges_.row(t) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(inverse.data());
  }
  if (hasPatches(materials_)) smoothed_ = smoothedGradients(rest_vertices, tets, materials_);
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
    energy += volumes_[t] * corotatedEnergy(edgesOf(x, tets_.row(t)) * inverse, tetLame(t), &stress);
    const Eigen::Matrix3d forces = volumes_[t] * stress * inverse.transpose();
    for (int k = 0; k < 3; ++k) gradient->row(tets_(t, k + 1)) += forces.col(k).transpose();
    gradient->row(tets_(t, 0)) -= (forces.col(0) + forces.col(1) + forces.col(2)).transpose();
  }
  return energy;
}

double CorotatedElasticity::addSmoothed(const Points& x, Points* gradient) const {
  double energy = 0.0;
  for (Eigen::Index p = 0; p < smoothed_.volumes.size(); ++p) {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero(), stress;
    for (int e = smoothed_.first[p]; e < smoothed_.first[p + 1]; ++e)
      F += x.row(smoothed_.vertices[e]).transpose() * smoothed_.gradients.row(e);
    const double volume = smoothed_.volumes[p];
    energy += volume * corotatedEnergy(F, patchLame(p), &stress);
    for (int e = smoothed_.first[p]; e < smoothed_.first[p + 1]; ++e)
      gradient->row(smoothed_.vertices[e]) += volume * smoothed_.gradients.row(e) * stress.transpose();
  }
  return energy;
}

void CorotatedElasticity::addMetric(TetMatrix* matrix) const {
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const Lame& lame = materials_.of(t).lame;
    const double stiffness = 2.0 * lame.mu + 3.0 * lame.lambda;
    Eigen::Matrix<double, 3, 4> G;  // gradients of the shape functions
    G.rightCols<3>() = inverseEdges(t).transpose();
    G.col(0) = -G.rightCols<3>().rowwise().sum();
    matrix->addToTet(static_cast<int>(t), stiffness * volumes_[t] * G.transpose() * G);
  }
}

}  // namespace softbody
