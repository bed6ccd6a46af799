#include "time_step/rigid_correction.h"

#include <Eigen/Dense>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

template <typename T>
RigidCorrection<T>::RigidCorrection(const TetTopology& topology)
    : piece_of_vertex_(static_cast<std::size_t>(topology.rest_vertices.rows())),
      exact_basis_(piece_of_vertex_.size()),
      exact_stiffness_(piece_of_vertex_.size()),
      basis_{std::vector<Block>(piece_of_vertex_.size(), Block::Zero()), {}},
      stiffness_(basis_),
      couplings_of_vertex_(piece_of_vertex_.size(), -1),
      corrected_(Rows<T>::Zero(paddedRows(topology.rest_vertices.rows()), 4)) {
  const std::vector<std::vector<int>> pieces = verticesOfPieces(topology.tets, topology.rest_vertices.rows());
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const int v : pieces[p]) piece_of_vertex_[static_cast<std::size_t>(v)] = p;
  pieces_.resize(pieces.size());
  for (Vector* vector : {&coefficients_, &direct_, &sums_})
    vector->setZero(static_cast<Eigen::Index>(6 * pieces.size()));
}

template <typename T>
void RigidCorrection<T>::linearize(const IncrementalPotential& potential, const Points& x) {
  setCenters(x);
  for (std::size_t v = 0; v < piece_of_vertex_.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    exact_basis_[v] = motionJacobian(x.row(row).transpose() - pieces_[piece_of_vertex_[v]].center);
    exact_stiffness_[v] = potential.inertia[row] * exact_basis_[v];
  }
  for (const Coupling& coupling : stiffness_.couplings) couplings_of_vertex_[coupling.vertex] = -1;
  stiffness_.couplings.clear();
  for (const TargetEnergy::Spring& spring : potential.targets.springs()) addSpring(spring, x);
  for (std::size_t v = 0; v < piece_of_vertex_.size(); ++v) {
    pieces_[piece_of_vertex_[v]].curvature += exact_basis_[v].transpose() * exact_stiffness_[v];
    basis_.blocks[v].template topRows<3>() = exact_basis_[v].template cast<T>();
    stiffness_.blocks[v].template topRows<3>() = exact_stiffness_[v].template cast<T>();
  }
  for (Coupling& coupling : stiffness_.couplings)
    coupling.block.template topRows<3>() = coupling.exact.template cast<T>();
  invert();
}

template <typename T>
void RigidCorrection<T>::invert() {
  if (stiffness_.couplings.empty()) {
    for (Piece& piece : pieces_) piece.inverse = piece.curvature.inverse().template cast<T>();
    return;
  }
  curvature_.setZero(coefficients_.size(), coefficients_.size());
  const auto placeOf = [](std::size_t piece) { return static_cast<Eigen::Index>(6 * piece); };
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    curvature_.block<6, 6>(placeOf(p), placeOf(p)) = pieces_[p].curvature;
  for (const Coupling& coupling : stiffness_.couplings)
    curvature_.block<6, 6>(placeOf(piece_of_vertex_[coupling.vertex]), placeOf(coupling.piece)) +=
        exact_basis_[coupling.vertex].transpose() * coupling.exact;
  inverse_ = curvature_.inverse().template cast<T>();
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
  const std::size_t piece = piece_of_vertex_[static_cast<std::size_t>(spring.vertices[0])];
  const Basis forces = curvature * motionsAt(spring.vertices, spring.barycentric);
  addForces(spring.vertices, spring.barycentric, piece, forces);
  if (!spring.isCoupled()) return;
  const std::size_t other = piece_of_vertex_[static_cast<std::size_t>(spring.other_vertices[0])];
  const Basis other_forces = curvature * motionsAt(spring.other_vertices, spring.other_barycentric);
  addForces(spring.other_vertices, spring.other_barycentric, other, other_forces);
  addForces(spring.vertices, spring.barycentric, other, -other_forces);
  addForces(spring.other_vertices, spring.other_barycentric, piece, -forces);
}

/// How the rigid motions move the point.
template <typename T>
typename RigidCorrection<T>::Basis RigidCorrection<T>::motionsAt(const Eigen::Vector4i& vertices,
                                                                 const Eigen::Vector4d& barycentric) const {
  Basis motions = Basis::Zero();
  for (int k = 0; k < 4; ++k) motions += barycentric[k] * exact_basis_[static_cast<std::size_t>(vertices[k])];
  return motions;
}

/// Adds the forces on a point by the motions of a piece, its own or another one.
template <typename T>
void RigidCorrection<T>::addForces(const Eigen::Vector4i& vertices, const Eigen::Vector4d& barycentric,
                                   std::size_t piece, const Basis& forces) {
  for (int k = 0; k < 4; ++k) {
    const auto v = static_cast<std::size_t>(vertices[k]);
    if (piece_of_vertex_[v] == piece) {
      exact_stiffness_[v] += barycentric[k] * forces;
      continue;
    }
    int c = couplings_of_vertex_[v];
    while (c >= 0 && stiffness_.couplings[static_cast<std::size_t>(c)].piece != piece)
      c = stiffness_.couplings[static_cast<std::size_t>(c)].next;
    if (c < 0) {
      c = static_cast<int>(stiffness_.couplings.size());
      stiffness_.couplings.push_back({v, piece, Basis::Zero(), Block::Zero(), couplings_of_vertex_[v]});
      couplings_of_vertex_[v] = c;
    }
    stiffness_.couplings[static_cast<std::size_t>(c)].exact += barycentric[k] * forces;
  }
}

template <typename T>
void RigidCorrection<T>::setCoefficients(const Columns& columns, const Rows<T>& rows) {
  const auto add = [&](std::size_t piece, const Block& block, std::size_t vertex) {
    sums_.template segment<6>(static_cast<Eigen::Index>(6 * piece)) +=
        block.transpose() * rows.row(static_cast<Eigen::Index>(vertex)).transpose();
  };
  sums_.setZero();
  for (std::size_t v = 0; v < columns.blocks.size(); ++v) add(piece_of_vertex_[v], columns.blocks[v], v);
  for (const Coupling& coupling : columns.couplings) add(coupling.piece, coupling.block, coupling.vertex);
  if (!stiffness_.couplings.empty()) {
    coefficients_.noalias() = inverse_ * sums_;
    return;
  }
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const auto place = static_cast<Eigen::Index>(6 * p);
    coefficients_.template segment<6>(place).noalias() =
        pieces_[p].inverse * sums_.template segment<6>(place);
  }
}

template <typename T>
void RigidCorrection<T>::subtract(const Columns& columns, const Vector& coefficients, Rows<T>* rows) const {
  const auto take = [&](std::size_t piece, const Block& block, std::size_t vertex) {
    rows->row(static_cast<Eigen::Index>(vertex)) -=
        (block * coefficients.template segment<6>(static_cast<Eigen::Index>(6 * piece))).transpose();
  };
  for (std::size_t v = 0; v < columns.blocks.size(); ++v) take(piece_of_vertex_[v], columns.blocks[v], v);
  for (const Coupling& coupling : columns.couplings) take(coupling.piece, coupling.block, coupling.vertex);
}

template class RigidCorrection<float>;
template class RigidCorrection<double>;

}  // namespace softbody
