#include "estimation/turned_modes.h"

#include <Eigen/Dense>
#include <cmath>

#include "elasticity/rotation.h"
#include "tets/tet_shape.h"

namespace softbody {

TurnedModes::TurnedModes(const TetTopology& topology) : tets_(topology.tets) {
  for (const auto& tet : tets_.rowwise()) {
    const Eigen::Matrix3d edges = edgesOf(topology.rest_vertices, tet);
    weighted_.emplace_back(edges.determinant() / 6.0 * edges.inverse());
  }
}

/// The rotation of the tets around each vertex.
std::vector<Eigen::Matrix3d> TurnedModes::rotationsOf(const Points& vertices) const {
  std::vector<Eigen::Matrix3d> rotations(static_cast<std::size_t>(vertices.rows()), Eigen::Matrix3d::Zero());
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const Eigen::Matrix3d F = edgesOf(vertices, tets_.row(t)) * weighted_[static_cast<std::size_t>(t)];
    for (int v : tets_.row(t)) rotations[static_cast<std::size_t>(v)] += F;
  }
  for (Eigen::Matrix3d& rotation : rotations) extractRotation(Eigen::Matrix3d(rotation), &rotation);
  return rotations;
}

TurnedModes::Rigid TurnedModes::rigidMotions(const std::vector<int>& piece, const Points& vertices,
                                             const std::vector<Eigen::Matrix3d>& rotations) const {
  const Points places = vertices(piece, Eigen::all);
  const Eigen::RowVector3d center = places.colwise().mean();
  const double radius =
      std::sqrt((places.rowwise() - center).squaredNorm() / static_cast<double>(places.rows()));
  Rigid motions(3 * places.rows(), kRigid);
  for (Eigen::Index v = 0; v < places.rows(); ++v) {
    const Eigen::RowVector3d arm = (places.row(v) - center) / radius;
    Eigen::Matrix3d turns;
    turns << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
    const auto to_vertex =
        rotations[static_cast<std::size_t>(piece[static_cast<std::size_t>(v)])].transpose();
    motions.block<3, 3>(3 * v, 0) = to_vertex;
    motions.block<3, 3>(3 * v, 3) = to_vertex * turns;
  }
  return motions;
}

}  // namespace softbody
