#include "dynamics/load_estimator.h"

#include <Eigen/Dense>
#include <cmath>

#include "softbody_common/tet_geometry.h"
#include "tets/tet_matrix.h"
#include "tets/tet_shape.h"

namespace softbody {
namespace {

// Length over which loads are spread, in edges of a cube with the body's volume. Hands press on a part of a
// side; shorter, loads would follow noise.
constexpr double kSpread = 0.5;

/// M + l^2 L, with the Laplacian weighted by density.
TetMatrix screenedPoisson(const TetTopology& topology, const Eigen::VectorXd& masses) {
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  const double length = kSpread * std::cbrt(volumes.sum()), density = masses.sum() / volumes.sum();
  TetMatrix matrix(topology.tets, topology.rest_vertices.rows());
  matrix.addToDiagonal(masses);
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    const Eigen::Matrix<double, 4, 3> gradients =
        shapeGradients(edgesOf(topology.rest_vertices, topology.tets.row(t)).inverse());
    matrix.addToTet(static_cast<int>(t),
                    length * length * density * volumes[t] * gradients * gradients.transpose());
  }
  return matrix;
}

}  // namespace

LoadEstimator::LoadEstimator(const TetTopology& topology, const Eigen::VectorXd& masses, double fade_s)
    : masses_(masses),
      pieces_(verticesOfPieces(topology.tets, masses.size())),
      piece_of_vertex_(static_cast<std::size_t>(masses.size())),
      fade_s_(fade_s),
      smoother_(TetMatrix(topology.tets, masses.size()).lower()),
      held_(pieces_.size()) {
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    for (int v : pieces_[piece]) piece_of_vertex_[static_cast<std::size_t>(v)] = piece;
  }
  if (fade_s_ > 0.0) smoother_.factorize(screenedPoisson(topology, masses).lower());
}

/// Removes the loads that would accelerate the piece as a rigid body.
void LoadEstimator::balancePiece(const std::vector<int>& piece, const Points& vertices, Points* loads) const {
  double mass = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), force = Eigen::Vector3d::Zero();
  for (int v : piece) {
    mass += masses_[v];
    center += masses_[v] * vertices.row(v).transpose();
    force += masses_[v] * loads->row(v).transpose();
  }
  center /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (int v : piece) {
    const Eigen::Vector3d arm = vertices.row(v).transpose() - center;
    inertia += masses_[v] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    torque += masses_[v] * arm.cross(loads->row(v).transpose());
  }
  const Eigen::Vector3d spin = inertia.ldlt().solve(torque);
  for (int v : piece) {
    const Eigen::Vector3d arm = vertices.row(v).transpose() - center;
    loads->row(v) -= (force / mass + spin.cross(arm)).transpose();
  }
}

void LoadEstimator::balance(const Points& vertices, Points* loads) const {
  for (const std::vector<int>& piece : pieces_) balancePiece(piece, vertices, loads);
}

void LoadEstimator::leaveOutHeldPieces(const std::vector<Pin>& pins) {
  held_.assign(held_.size(), false);
  for (const Pin& pin : pins) held_[piece_of_vertex_[static_cast<std::size_t>(pin.vertex)]] = true;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    if (!held_[piece]) continue;
    for (int v : pieces_[piece]) unexplained_.row(v).setZero();
  }
}

void LoadEstimator::update(const Points& springs, const std::vector<Pin>& pins, const Points& vertices,
                           double elapsed_s, Points* loads) {
  if (fade_s_ <= 0.0) return;
  unexplained_ = springs;
  leaveOutHeldPieces(pins);
  smoother_.solve(unexplained_, &spread_);
  *loads = std::exp(-elapsed_s / fade_s_) * *loads + spread_;
  balance(vertices, loads);
}

}  // namespace softbody
