#include "cutting/blade/rest_map.h"

#include <Eigen/Dense>

#include "softbody_common/geometry/tet_geometry.h"
#include "tets/tet_shape.h"

namespace softbody {
namespace {

/// The rotation of the polar decomposition.
Eigen::Matrix3d rotationOf(const Eigen::Matrix3d& F) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) *= -1.0;
  return U * svd.matrixV().transpose();
}

}  // namespace

RestSolid::RestSolid(const MeshTopology& uncut) : surface_({uncut.rest_vertices, uncut.triangles}) {
  const Eigen::RowVector3d low = uncut.rest_vertices.colwise().minCoeff(),
                           high = uncut.rest_vertices.colwise().maxCoeff();
  // Oblique, so that rays do not run along the faces of a box.
  outside_ = high.transpose() + (high - low).norm() * Eigen::Vector3d(0.713, 0.421, 0.937);
}

bool RestSolid::contains(const Eigen::Vector3d& point) const {
  return surface_.hits(point, outside_).size() % 2 == 1;
}

RestMap::RestMap(const TetTopology& volume, const Points& deformed, const RestSolid& solid)
    : volume_(volume), solid_(solid), deformed_(deformed), locator_(deformed, volume.tets) {}

Points RestMap::toRest(const Points& points) const {
  Points rest(points.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    rest.row(i) = toRest(Eigen::Vector3d(points.row(i))).transpose();
  return rest;
}

Eigen::Vector3d RestMap::toRest(const Eigen::Vector3d& point) const {
  const MaterialPoint place = locator_.locate(point);
  if (place.barycentric.minCoeff() >= 0.0) return positionOf(place, volume_.rest_vertices, volume_.tets);
  MaterialPoint near = place;  // on the tet
  near.barycentric = near.barycentric.cwiseMax(0.0);
  near.barycentric /= near.barycentric.sum();
  const Eigen::RowVector4i tet = volume_.tets.row(place.tet);
  const Eigen::Matrix3d F = edgesOf(deformed_, tet) * edgesOf(volume_.rest_vertices, tet).inverse();
  const Eigen::Vector3d on_tet = positionOf(near, volume_.rest_vertices, volume_.tets);
  const Eigen::Vector3d beyond =
      on_tet + rotationOf(F).transpose() * (point - positionOf(near, deformed_, volume_.tets));
  return solid_.contains(beyond) ? on_tet : beyond;
}

}  // namespace softbody
