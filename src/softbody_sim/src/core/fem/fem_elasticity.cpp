#include "fem/fem_elasticity.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <stdexcept>

#include "tets/tet_shape.h"

namespace softbody {
namespace {

using Matrix9 = EdgeSprings::Hessian;
using Vector9 = Eigen::Matrix<double, 9, 1>;

/// F = U diag(stretches) V^T with rotations U and V; the last stretch is negative where F is inverted.
struct PrincipalAxes {
  Eigen::Matrix3d U, V;
  Eigen::Vector3d stretches;
};

PrincipalAxes principalAxes(const Eigen::Matrix3d& F) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  PrincipalAxes axes{svd.matrixU(), svd.matrixV(), svd.singularValues()};
  for (Eigen::Matrix3d* rotation : {&axes.U, &axes.V}) {
    if (rotation->determinant() > 0.0) continue;
    rotation->col(2) = -rotation->col(2);
    axes.stretches[2] = -axes.stretches[2];
  }
  return axes;
}

/// Adds eigenvalue * q q^T for the mode q = U Q V^T.
void addMode(double eigenvalue, const PrincipalAxes& axes, const Eigen::Matrix3d& Q, bool project,
             Matrix9* hessian) {
  if (project && eigenvalue <= 0.0) return;
  const Eigen::Matrix3d mode = axes.U * Q * axes.V.transpose();
  const Eigen::Map<const Vector9> q(mode.data());
  hessian->noalias() += eigenvalue * q * q.transpose();
}

/// The Hessian by vec(F), from its nine eigenvectors: three scalings, three twists, three flips.
Matrix9 densityHessian(const IsotropicEnergy& density, const PrincipalAxes& axes, bool project) {
  Matrix9 hessian = Matrix9::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> scalings(density.hessian);
  for (int i = 0; i < 3; ++i) {
    addMode(scalings.eigenvalues()[i], axes, scalings.eigenvectors().col(i).asDiagonal(), project, &hessian);
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (const double sign : {-1.0, 1.0}) {
      Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();
      Q(j, k) = std::sqrt(0.5);
      Q(k, j) = sign * std::sqrt(0.5);
      addMode(sign < 0.0 ? density.twist[i] : density.flip[i], axes, Q, project, &hessian);
    }
  }
  return hessian;
}

EdgeSprings springsOf(const Points& rest_vertices, const Eigen::RowVector4i& tet, const Lame& lame) {
  EdgeSprings::Edges edges;
  edges.leftCols<3>() = edgesOf(rest_vertices, tet);
  for (int k = 0; k < 3; ++k) edges.col(3 + k) = edges.col((k + 1) % 3) - edges.col(k);
  return {edges, youngsModulus(lame)};
}

}  // namespace

FemElasticity::FemElasticity(const TetTopology& topology, Elasticity elasticity,
                             const ElasticMaterials& materials)
    : elasticity_(elasticity) {
  const Eigen::VectorXd volumes = positiveVolumes(topology.rest_vertices, topology.tets);
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    const Eigen::RowVector4i tet = topology.tets.row(t);
    elements_.push_back({tet, shapeGradients(edgesOf(topology.rest_vertices, tet).inverse()), volumes[t],
                         tetPart(materials.of(t))});
    if (elasticity == Elasticity::kSprings)
      elements_.back().springs = springsOf(topology.rest_vertices, tet, elements_.back().lame);
  }
  if (!hasPatches(materials)) return;
  if (elasticity == Elasticity::kSprings)
    throw std::invalid_argument("the strains of springs cannot be smoothed");
  addPatches(topology, materials);
}

void FemElasticity::addPatches(const TetTopology& topology, const ElasticMaterials& materials) {
  const SmoothedGradients smoothed = smoothedGradients(topology.rest_vertices, topology.tets, materials);
  for (Eigen::Index p = 0; p < smoothed.volumes.size(); ++p) {
    const int first = smoothed.first[p], count = smoothed.first[p + 1] - first;
    const auto kind = static_cast<std::size_t>(smoothed.kinds[static_cast<std::size_t>(p)]);
    elements_.push_back({Eigen::Map<const Eigen::VectorXi>(smoothed.vertices.data() + first, count),
                         smoothed.gradients.middleRows(first, count), smoothed.volumes[p],
                         patchPart(materials.kinds[kind])});
  }
}

std::vector<Eigen::VectorXi> FemElasticity::groups() const {
  std::vector<Eigen::VectorXi> groups;
  for (const Element& element : elements_) groups.push_back(element.vertices);
  return groups;
}

Eigen::Matrix3d FemElasticity::deformationGradient(const Element& element, const Points& x) const {
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < element.vertices.size(); ++k)
    F += x.row(element.vertices[k]).transpose() * element.shape_gradients.row(k);
  return F;
}

FemElasticity::Density FemElasticity::density(const Element& element, const Eigen::Matrix3d& F) const {
  if (elasticity_ == Elasticity::kSprings) return {element.springs.energy(F), element.springs.stress(F)};
  const PrincipalAxes axes = principalAxes(F);
  const IsotropicEnergy density = isotropicEnergy(elasticity_, axes.stretches, element.lame);
  return {density.energy, axes.U * density.gradient.asDiagonal() * axes.V.transpose()};
}

EdgeSprings::Hessian FemElasticity::hessian(const Element& element, const Eigen::Matrix3d& F,
                                            bool project) const {
  if (elasticity_ == Elasticity::kSprings) return element.springs.hessian(F, project);
  const PrincipalAxes axes = principalAxes(F);
  return densityHessian(isotropicEnergy(elasticity_, axes.stretches, element.lame), axes, project);
}

double FemElasticity::addTo(const Points& x, Points* gradient) const {
  double energy = 0.0;
  for (const Element& element : elements_) {
    const auto [of_volume, stress] = density(element, deformationGradient(element, x));
    energy += element.volume * of_volume;
    for (Eigen::Index k = 0; k < element.vertices.size(); ++k)
      gradient->row(element.vertices[k]) +=
          element.volume * element.shape_gradients.row(k) * stress.transpose();
  }
  return energy;
}

void FemElasticity::addHessian(const Points& x, BlockTetMatrix* matrix, bool project) const {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    const Matrix9 H = hessian(element, deformationGradient(element, x), project);
    // d vec(F) / d vertices: column 3 a + c moves component c of vertex a.
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(9, 3 * element.vertices.size());
    for (Eigen::Index a = 0; a < element.vertices.size(); ++a) {
      for (int j = 0; j < 3; ++j) {
        for (int c = 0; c < 3; ++c) B(3 * j + c, 3 * a + c) = element.shape_gradients(a, j);
      }
    }
    matrix->addToGroup(e, element.volume * B.transpose() * H * B);
  }
}

}  // namespace softbody
