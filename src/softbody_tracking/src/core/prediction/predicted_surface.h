#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "prediction/raster_memory.h"
#include "prediction/surface_model.h"
#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"
#include "softbody_common/images/rasterizer.h"

namespace softbody {

/// Change of a MaterialPoint's barycentric coordinates per pixel, 4 by 2.
using PlaceGradient = Eigen::Matrix<double, 4, 2>;

/// The visual surface for a state of the volume, rendered as the camera sees it. A value: copies share the
/// model and the image, and neither changes.
class PredictedSurface {
 public:
  /// Moves the surface with the volume's vertices and renders it. @param volume_vertices camera frame [m].
  PredictedSurface(std::shared_ptr<const SurfaceModel> model, const Pinhole& camera,
                   const Points& volume_vertices, RasterMemory* memory);

  const SurfaceModel& model() const { return *model_; }
  const TetTopology& volume() const { return model_->volume(); }
  std::uint32_t pieceOf(const MaterialPoint& place) const { return model_->pieceOf(place); }
  std::size_t pieceCount() const { return model_->pieceCount(); }

  const Pinhole& camera() const { return camera_; }
  const Points& volumeVertices() const { return volume_vertices_; }
  /// Positions of the volume's vertices, for each piece [m].
  std::vector<Points> pieceVertices() const;
  /// The volume's vertices, each moved by the motion of its piece.
  Points movedVolume(const RigidMotions& motions) const { return model_->moved(volume_vertices_, motions); }
  /// Triangle and depth of every pixel, as rendered.
  const RasterImage& image() const { return *image_; }

  /// The visible triangle at a measured point. @param tolerance distance along the ray [m].
  /// @return -1 if the moved surface is further away than the tolerance.
  int triangleAt(const Eigen::Vector3d& measured, double tolerance) const;
  /// The place in the rest body where the ray through a pixel meets a triangle's plane.
  MaterialPoint materialPoint(int triangle, const cv::Point2f& pixel) const;
  /// Change of a place's barycentric coordinates on a triangle's plane, per pixel to the right (first column)
  /// and downwards (second column).
  PlaceGradient placeGradient(const MaterialPoint& place, int triangle, const cv::Point2f& pixel) const;
  /// Pixels of this image per pixel of the image in which the gradient was taken, 2 by 2.
  Eigen::Matrix2f imageWarp(const MaterialPoint& place, const PlaceGradient& gradient) const;
  /// Outward unit normal of a triangle, camera frame. It is not smoothed: at a sharp edge, the mean normal of
  /// both sides would pull the surface off both sides.
  Eigen::Vector3d normal(int triangle) const;
  Eigen::Vector3d position(const MaterialPoint& place) const;

 private:
  friend PredictedSurface moved(PredictedSurface surface, const RigidMotions& motions);

  Eigen::Matrix3d corners(int triangle) const;
  Eigen::Vector3d restPoint(int triangle, const cv::Point2f& pixel) const;

  std::shared_ptr<const SurfaceModel> model_;
  Pinhole camera_;
  Points volume_vertices_;
  Points vertices_;       ///< of the surface, as rendered
  RigidMotions motions_;  ///< since then; empty: not moved
  std::shared_ptr<const RasterImage> image_;
};

/// The surface with each piece of the body moved. The image stays as rendered.
PredictedSurface moved(PredictedSurface surface, const RigidMotions& motions);

}  // namespace softbody
