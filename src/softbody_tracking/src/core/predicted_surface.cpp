#include "predicted_surface.h"

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
  normals_ = vertexNormals(vertices_, surface_.triangles);
  rasterize(camera, vertices_, surface_.triangles, &image_);
}

Eigen::Vector3d PredictedSurface::corners(const cv::Point& pixel, const Points& values) const {
  const int f = image_.triangle(pixel);
  const cv::Vec2f b = image_.barycentric(pixel);
  return b[0] * values.row(surface_.triangles(f, 0)) + b[1] * values.row(surface_.triangles(f, 1)) +
         (1.0f - b[0] - b[1]) * values.row(surface_.triangles(f, 2));
}

MaterialPoint PredictedSurface::materialPoint(const cv::Point& pixel) const {
  const Eigen::Vector3d rest = corners(pixel, surface_.rest_vertices);
  // One of the tets that hold the triangle's corners holds the point too, or nearly so: far cheaper than a
  // search.
  MaterialPoint best;
  for (int k = 0; k < 3; ++k) {
    const int tet = binding_[surface_.triangles(image_.triangle(pixel), k)].tet;
    if (tet == best.tet) continue;
    const Eigen::Vector4d barycentric =
        barycentricCoordinates(rest, volume_.rest_vertices, volume_.tets.row(tet));
    if (best.tet < 0 || barycentric.minCoeff() > best.barycentric.minCoeff()) best = {tet, barycentric};
  }
  return best;
}

Eigen::Vector3d PredictedSurface::normal(const cv::Point& pixel) const {
  return corners(pixel, normals_).normalized();
}

Eigen::Vector3d PredictedSurface::position(const MaterialPoint& place) const {
  return positionOf(place, volume_vertices_, volume_.tets);
}

}  // namespace softbody
