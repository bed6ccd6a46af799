#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_common/types.h"

namespace softbody {

/// Place in an image.
struct ProjectedVertex {
  double u, v;       ///< [px]
  double inverse_z;  ///< [1/m]
};

/// What a pinhole camera sees of a triangle mesh. Images have the camera's size.
struct RasterImage {
  cv::Mat1f depth;                         ///< z at the pixel centre [m]; 0: nothing
  cv::Mat1i triangle;                      ///< index of the visible triangle; -1: nothing
  cv::Rect region;                         ///< holds every covered pixel; may be a little larger
  std::vector<ProjectedVertex> projected;  ///< the mesh's vertices; NaN where too near
};

/// What is drawn: of a closed mesh the faces that look away are hidden, and half of the work.
enum class Faces { kAll, kFront };

/// Renders by z-buffer; triangles that reach nearer than 1 cm to the camera plane are left out. The image's
/// memory is reused when the size fits. @throw std::invalid_argument if an index is out of range.
void rasterize(const Pinhole& camera, const Points& vertices, const Triangles& triangles, RasterImage* image,
               Faces faces = Faces::kAll);

/// Weights of a triangle's corners (columns, [m]) where the ray through (u, v) meets its plane; they sum
/// to 1.
Eigen::Vector3d rayWeights(const Pinhole& camera, const Eigen::Matrix3d& corners, double u, double v);

/// Weights of a triangle's corners where the ray through (u, v) meets its plane; they sum to 1.
Eigen::Vector3d rayWeights(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
                           int triangle, double u, double v);

}  // namespace softbody
