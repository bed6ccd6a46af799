#include "time_step/rigid_correction.h"

#include <Eigen/Dense>

#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

using Basis = Eigen::Matrix<double, 3, 6>;

/// A small turn about the origin moves a point by turn x point, a shift moves it by itself.
Basis motionsOf(const Eigen::Vector3d& point) {
  Basis motions;
  for (int k = 0; k < 3; ++k) motions.col(k) = Eigen::Vector3d::Unit(k).cross(point);
  motions.rightCols<3>().setIdentity();
  return motions;
}

}  // namespace

template <typename T>
RigidCorrection<T>::RigidCorrection(const TetTopology& topology)
    : piece_of_vertex_(static_cast<std::size_t>(topology.rest_vertices.rows())),
      basis_(piece_of_vertex_.size(), Block::Zero()),
      stiffness_(basis_),
      corrected_(Rows<T>::Zero(paddedRows(topology.rest_vertices.rows()), 4)) {
  const std::vector<std::vector<int>> pieces =
      verticesOfPieces(topology.tets, topology.rest_vertices.rows());
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const int v : pieces[p]) piece_of_vertex_[static_cast<std::size_t>(v)] = p;
  inverse_.resize(pieces.size());
  coefficients_.resize(pieces.size());
  direct_.resize(pieces.size());
}

template <typename T>
void RigidCorrection<T>::linearize(const IncrementalPotential& potential, const Points& x) {
  std::vector<Eigen::Vector3d> centers(inverse_.size(), Eigen::Vector3d::Zero());
  std::vector<double> counts(inverse_.size(), 0.0);
  for (std::size_t v = 0; v < piece_of_vertex_.size(); ++v) {
    centers[piece_of_vertex_[v]] += x.row(static_cast<Eigen::Index>(v)).transpose();
    counts[piece_of_vertex_[v]] += 1.0;
  }
  for (std::size_t p = 0; p < centers.size(); ++p) centers[p] /= counts[p];

  std::vector<Basis> basis(piece_of_vertex_.size()), stiffness(piece_of_vertex_.size());
  for (std::size_t v = 0; v < basis.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    basis[v] = motionsOf(x.row(row).transpose() - centers[piece_of_vertex_[v]]);
    stiffness[v] = potential.inertia[row] * basis[v];
  }
  for (const TargetEnergy::Spring& spring : potential.targets.springs()) {
    const Eigen::Matrix3d curvature = TargetEnergy::curvatureAt(spring, x);
    if (curvature.isZero(0.0)) continue;
    Basis motions = Basis::Zero();
    for (int k = 0; k < 4; ++k)
      motions += spring.barycentric[k] * basis[static_cast<std::size_t>(spring.vertices[k])];
    const Basis forces = curvature * motions;
    for (int k = 0; k < 4; ++k)
      stiffness[static_cast<std::size_t>(spring.vertices[k])] += spring.barycentric[k] * forces;
  }
  std::vector<Matrix6> curvatures(inverse_.size(), Matrix6::Zero());
  for (std::size_t v = 0; v < basis.size(); ++v)
    curvatures[piece_of_vertex_[v]] += basis[v].transpose() * stiffness[v];
  for (std::size_t p = 0; p < inverse_.size(); ++p) inverse_[p] = curvatures[p].inverse().template cast<T>();
  for (std::size_t v = 0; v < basis.size(); ++v) {
    basis_[v].template topRows<3>() = basis[v].template cast<T>();
    stiffness_[v].template topRows<3>() = stiffness[v].template cast<T>();
  }
}

template <typename T>
void RigidCorrection<T>::setCoefficients(const std::vector<Block>& blocks, const Rows<T>& rows) {
  for (Vector6& c : coefficients_) c.setZero();
  for (std::size_t v = 0; v < blocks.size(); ++v)
    coefficients_[piece_of_vertex_[v]] +=
        blocks[v].transpose() * rows.row(static_cast<Eigen::Index>(v)).transpose();
  for (std::size_t p = 0; p < inverse_.size(); ++p) coefficients_[p] = (inverse_[p] * coefficients_[p]).eval();
}

template <typename T>
void RigidCorrection<T>::subtract(const std::vector<Block>& blocks, const std::vector<Vector6>& coefficients,
                                  Rows<T>* rows) const {
  for (std::size_t v = 0; v < blocks.size(); ++v)
    rows->row(static_cast<Eigen::Index>(v)) -= (blocks[v] * coefficients[piece_of_vertex_[v]]).transpose();
}

template class RigidCorrection<float>;
template class RigidCorrection<double>;

}  // namespace softbody
