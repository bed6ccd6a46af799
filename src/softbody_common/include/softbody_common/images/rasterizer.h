#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A vertex in the image.
struct ProjectedVertex {
  double u, v;       ///< [px]
  double inverse_z;  ///< [1/m]
};

/// A triangle mesh, rendered for a pinhole camera. The images have the camera's size.
struct RasterImage {
  cv::Mat1f depth;                         ///< z at the pixel centre [m]; 0: nothing
  cv::Mat1i triangle;                      ///< index of the visible triangle; -1: nothing
  cv::Rect region;                         ///< contains every covered pixel; may be a little larger
  std::vector<ProjectedVertex> projected;  ///< the mesh's vertices; NaN if too near
};

/// The faces to draw. kFront is enough for a closed mesh, and takes half of the time.
enum class Faces { kAll, kFront };

/// Renders with a z-buffer. Leaves out triangles that are nearer than 1 cm to the camera plane. Reuses the
/// image's memory if the size fits. @throw std::invalid_argument if an index is out of range.
void rasterize(const Pinhole& camera, const Points& vertices, const Triangles& triangles, RasterImage* image,
               Faces faces = Faces::kAll);

/// Weights of a triangle's corners (columns, [m]) where the ray through (u, v) meets its plane; they sum
/// to 1.
Eigen::Vector3d rayWeights(const Pinhole& camera, const Eigen::Matrix3d& corners, double u, double v);

/// Weights of a triangle's corners where the ray through (u, v) meets its plane; they sum to 1.
Eigen::Vector3d rayWeights(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
                           int triangle, double u, double v);

}  // namespace softbody
