#include "estimation/turned_modes.h"

#include <Eigen/Dense>
#include <cmath>

#include "elasticity/rotation.h"
#include "softbody_common/tet_geometry.h"
#include "tets/tet_shape.h"

namespace softbody {

TurnedModes::TurnedModes(const TetTopology& topology)
    : tets_(topology.tets), pieces_(verticesOfPieces(topology.tets, topology.rest_vertices.rows())) {
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

void TurnedModes::at(const Points& vertices, const Eigen::MatrixXd& shapes, Motions* motions) const {
  motions->setZero(3 * vertices.rows(), rigidCount() + shapes.cols());
  const std::vector<Eigen::Matrix3d> rotations = rotationsOf(vertices);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    motions->block(3 * v, rigidCount(), 3, shapes.cols()).noalias() =
        rotations[static_cast<std::size_t>(v)] * shapes.middleRows(3 * v, 3);
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    const Points places = vertices(pieces_[piece], Eigen::all);
    const Eigen::RowVector3d center = places.colwise().mean();
    const double radius =
        std::sqrt((places.rowwise() - center).squaredNorm() / static_cast<double>(places.rows()));
    for (int v : pieces_[piece]) {
      const Eigen::RowVector3d arm = (vertices.row(v) - center) / radius;
      auto block = motions->block<3, 6>(3 * v, 6 * static_cast<Eigen::Index>(piece));
      block.leftCols<3>().setIdentity();
      block.rightCols<3>() << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
    }
  }
}

}  // namespace softbody
