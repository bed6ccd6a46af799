#include "prediction/predicted_surface.h"

#include <Eigen/Dense>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

std::shared_ptr<const RasterImage> rendered(const SurfaceModel& model, const Pinhole& camera,
                                            const Points& vertices, RasterMemory* memory) {
  std::shared_ptr<RasterImage> image = memory->freeImage();
  rasterize(camera, vertices, model.surface().triangles, image.get(), model.faces());
  return image;
}

}  // namespace

PredictedSurface::PredictedSurface(std::shared_ptr<const SurfaceModel> model, const Pinhole& camera,
                                   const Points& volume_vertices, RasterMemory* memory)
    : model_(std::move(model)),
      camera_(camera),
      volume_vertices_(volume_vertices),
      vertices_(model_->surfaceVertices(volume_vertices)),
      image_(rendered(*model_, camera, vertices_, memory)) {}

std::vector<Points> PredictedSurface::pieceVertices() const {
  std::vector<Points> result;
  for (const std::vector<int>& piece : model_->pieces())
    result.emplace_back(volume_vertices_(piece, Eigen::all));
  return result;
}

PredictedSurface moved(PredictedSurface surface, const RigidMotions& motions) {
  surface.volume_vertices_ = surface.movedVolume(motions);
  surface.motions_.resize(motions.size(), Eigen::Isometry3d::Identity());
  for (std::size_t piece = 0; piece < motions.size(); ++piece)
    surface.motions_[piece] = motions[piece] * surface.motions_[piece];
  return surface;
}

/// A triangle's corners as columns, camera frame [m].
Eigen::Matrix3d PredictedSurface::corners(int triangle) const {
  const MeshTopology& mesh = model_->surface();
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = vertices_.row(mesh.triangles(triangle, k));
  if (motions_.empty()) return corners;
  return motions_[model_->pieceOfTriangle(triangle)] * corners;
}

int PredictedSurface::triangleAt(const Eigen::Vector3d& measured, double tolerance) const {
  for (std::size_t piece = 0; piece < pieceCount(); ++piece) {
    const Eigen::Vector3d rendered =
        motions_.empty() ? measured : Eigen::Vector3d(motions_[piece].inverse(Eigen::Isometry) * measured);
    if (!(rendered.z() > 0.0)) continue;
    const Eigen::Vector2d pixel = camera_.project(rendered);
    if (!camera_.contains(pixel.x(), pixel.y())) continue;
    const cv::Point nearest(cvRound(pixel.x()), cvRound(pixel.y()));
    const int triangle = image_->triangle(nearest);
    if (triangle < 0 || std::abs(rendered.z() - image_->depth(nearest)) > tolerance) continue;
    if (model_->pieceOfTriangle(triangle) == piece) return triangle;
  }
  return -1;
}

/// The point of the rest shape where the ray through a pixel meets a triangle's plane.
Eigen::Vector3d PredictedSurface::restPoint(int triangle, const cv::Point2f& pixel) const {
  const MeshTopology& mesh = model_->surface();
  const Eigen::Vector3d weights = rayWeights(camera_, corners(triangle), pixel.x, pixel.y);
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    rest += weights[k] * mesh.rest_vertices.row(mesh.triangles(triangle, k)).transpose();
  return rest;
}

MaterialPoint PredictedSurface::materialPoint(int triangle, const cv::Point2f& pixel) const {
  return model_->placeOf(restPoint(triangle, pixel), triangle);
}

PlaceGradient PredictedSurface::placeGradient(const MaterialPoint& place, int triangle,
                                              const cv::Point2f& pixel) const {
  PlaceGradient gradient;
  gradient.col(0) = model_->barycentric(place.tet, restPoint(triangle, pixel + cv::Point2f(1, 0)));
  gradient.col(1) = model_->barycentric(place.tet, restPoint(triangle, pixel + cv::Point2f(0, 1)));
  return gradient.colwise() - place.barycentric;
}

Eigen::Matrix2f PredictedSurface::imageWarp(const MaterialPoint& place, const PlaceGradient& gradient) const {
  Eigen::Matrix<double, 3, 4> corners;
  for (int k = 0; k < 4; ++k) corners.col(k) = volume_vertices_.row(volume().tets(place.tet, k));
  const Eigen::Vector3d p = corners * place.barycentric;
  const Eigen::Matrix<double, 3, 2> offsets = corners * gradient;
  Eigen::Matrix<double, 2, 3> projection;
  projection << camera_.fx / p.z(), 0.0, -camera_.fx * p.x() / (p.z() * p.z()),  //
      0.0, camera_.fy / p.z(), -camera_.fy * p.y() / (p.z() * p.z());
  return (projection * offsets).cast<float>();
}

Eigen::Vector3d PredictedSurface::normal(int triangle) const {
  const Eigen::Matrix3d c = corners(triangle);
  return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).normalized();
}

Eigen::Vector3d PredictedSurface::position(const MaterialPoint& place) const {
  return positionOf(place, volume_vertices_, volume().tets);
}

}  // namespace softbody
