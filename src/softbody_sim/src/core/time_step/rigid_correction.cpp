#include "time_step/rigid_correction.h"

#include <Eigen/Dense>

#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

/// A small turn about the origin moves a point by turn x point, a shift moves it by itself.
Eigen::Matrix<double, 3, 6> motionsOf(const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 3, 6> motions;
  for (int k = 0; k < 3; ++k) motions.col(k) = Eigen::Vector3d::Unit(k).cross(point);
  motions.rightCols<3>().setIdentity();
  return motions;
}

}  // namespace

template <typename T>
RigidCorrection<T>::RigidCorrection(const TetTopology& topology)
    : piece_of_vertex_(static_cast<std::size_t>(topology.rest_vertices.rows())),
      exact_basis_(piece_of_vertex_.size()),
      exact_stiffness_(piece_of_vertex_.size()),
      basis_(piece_of_vertex_.size(), Block::Zero()),
      stiffness_(basis_),
      corrected_(Rows<T>::Zero(paddedRows(topology.rest_vertices.rows()), 4)) {
  const std::vector<std::vector<int>> pieces = verticesOfPieces(topology.tets, topology.rest_vertices.rows());
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const int v : pieces[p]) piece_of_vertex_[static_cast<std::size_t>(v)] = p;
  pieces_.resize(pieces.size());
  coefficients_.resize(pieces.size());
  direct_.resize(pieces.size());
}

template <typename T>
void RigidCorrection<T>::linearize(const IncrementalPotential& potential, const Points& x) {
  setCenters(x);
  for (std::size_t v = 0; v < piece_of_vertex_.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    exact_basis_[v] = motionsOf(x.row(row).transpose() - pieces_[piece_of_vertex_[v]].center);
    exact_stiffness_[v] = potential.inertia[row] * exact_basis_[v];
  }
  for (const TargetEnergy::Spring& spring : potential.targets.springs()) addSpring(spring, x);
  for (std::size_t v = 0; v < piece_of_vertex_.size(); ++v) {
    pieces_[piece_of_vertex_[v]].curvature += exact_basis_[v].transpose() * exact_stiffness_[v];
    basis_[v].template topRows<3>() = exact_basis_[v].template cast<T>();
    stiffness_[v].template topRows<3>() = exact_stiffness_[v].template cast<T>();
  }
  for (Piece& piece : pieces_) piece.inverse = piece.curvature.inverse().template cast<T>();
}

template <typename T>
void RigidCorrection<T>::setCenters(const Points& x) {
  for (Piece& piece : pieces_) {
    piece.center.setZero();
    piece.vertex_count = 0.0;
    piece.curvature.setZero();
  }
  for (std::size_t v = 0; v < piece_of_vertex_.size(); ++v) {
    Piece& piece = pieces_[piece_of_vertex_[v]];
    piece.center += x.row(static_cast<Eigen::Index>(v)).transpose();
    piece.vertex_count += 1.0;
  }
  for (Piece& piece : pieces_) piece.center /= piece.vertex_count;
}

template <typename T>
void RigidCorrection<T>::addSpring(const TargetEnergy::Spring& spring, const Points& x) {
  const Eigen::Matrix3d curvature = TargetEnergy::curvatureAt(spring, x);
  if (curvature.isZero(0.0)) return;
  Basis motions = Basis::Zero();
  for (int k = 0; k < 4; ++k)
    motions += spring.barycentric[k] * exact_basis_[static_cast<std::size_t>(spring.vertices[k])];
  const Basis forces = curvature * motions;
  for (int k = 0; k < 4; ++k)
    exact_stiffness_[static_cast<std::size_t>(spring.vertices[k])] += spring.barycentric[k] * forces;
}

template <typename T>
void RigidCorrection<T>::setCoefficients(const std::vector<Block>& blocks, const Rows<T>& rows) {
  for (Vector6& c : coefficients_) c.setZero();
  for (std::size_t v = 0; v < blocks.size(); ++v)
    coefficients_[piece_of_vertex_[v]] +=
        blocks[v].transpose() * rows.row(static_cast<Eigen::Index>(v)).transpose();
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    coefficients_[p] = (pieces_[p].inverse * coefficients_[p]).eval();
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
