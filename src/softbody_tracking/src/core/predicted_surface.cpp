#include "predicted_surface.h"

#include <Eigen/Dense>

#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_locator.h"

namespace softbody {

PredictedSurface::PredictedSurface(const TetTopology& volume, const MeshTopology& surface)
    : volume_(volume),
      surface_(surface),
      binding_(bindPoints(surface.rest_vertices, volume.rest_vertices, volume.tets)) {}

void PredictedSurface::update(const Pinhole& camera, const Points& volume_vertices) {
  camera_ = camera;
  volume_vertices_ = volume_vertices;
  vertices_ = applyBinding(binding_, volume_vertices, volume_.tets);
  rasterize(camera, vertices_, surface_.triangles, &image_);
}

Eigen::Vector3d PredictedSurface::interpolated(int triangle, const Eigen::Vector3d& barycentric,
                                               const Points& values) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) sum += barycentric[k] * values.row(surface_.triangles(triangle, k)).transpose();
  return sum;
}

MaterialPoint PredictedSurface::materialPoint(const cv::Point2f& pixel) const {
  const int triangle = image_.triangle(cvRound(pixel.y), cvRound(pixel.x));
  // The ray's multiples of the corners: solving sum_k b_k corner_k = z ray gives barycentric coordinates up
  // to scale.
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = vertices_.row(surface_.triangles(triangle, k)).transpose();
  const Eigen::Vector3d weights = corners.fullPivLu().solve(camera_.unproject(pixel.x, pixel.y, 1.0));
  const Eigen::Vector3d rest = interpolated(triangle, weights / weights.sum(), surface_.rest_vertices);
  // One of the tets that hold the triangle's corners holds the point too, or nearly so: far cheaper than a
  // search.
  MaterialPoint best;
  for (int k = 0; k < 3; ++k) {
    const int tet = binding_[surface_.triangles(triangle, k)].tet;
    if (tet == best.tet) continue;
    const Eigen::Vector4d barycentric =
        barycentricCoordinates(rest, volume_.rest_vertices, volume_.tets.row(tet));
    if (best.tet < 0 || barycentric.minCoeff() > best.barycentric.minCoeff()) best = {tet, barycentric};
  }
  return best;
}

Eigen::Vector3d PredictedSurface::normal(const cv::Point& pixel) const {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return vertices_.row(surface_.triangles(image_.triangle(pixel), k));
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

Eigen::Vector3d PredictedSurface::position(const MaterialPoint& place) const {
  return positionOf(place, volume_vertices_, volume_.tets);
}

}  // namespace softbody
