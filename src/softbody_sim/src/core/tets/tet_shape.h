#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Edge vectors from a tet's first vertex to the others, as columns [m].
inline Eigen::Matrix3d edgesOf(const Points& vertices, const Eigen::RowVector4i& tet) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = vertices.row(tet[k + 1]) - vertices.row(tet[0]);
  return edges;
}

/// Gradients of a tet's four barycentric coordinates, its shape functions [1/m], one a row.
/// @param inverse_edges the inverse of edgesOf at rest.
inline Eigen::Matrix<double, 4, 3> shapeGradients(const Eigen::Matrix3d& inverse_edges) {
  Eigen::Matrix<double, 4, 3> gradients;
  gradients.bottomRows<3>() = inverse_edges;
  gradients.row(0) = -inverse_edges.colwise().sum();
  return gradients;
}

/// Volumes at rest [m^3], #T. @throw std::invalid_argument unless all are positive.
Eigen::VectorXd positiveVolumes(const Points& rest_vertices, const Tets& tets);

}  // namespace softbody
