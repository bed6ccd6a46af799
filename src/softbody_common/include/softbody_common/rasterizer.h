#pragma once

#include <opencv2/core.hpp>

#include "softbody_common/pinhole.h"
#include "softbody_common/types.h"

namespace softbody {

/// What a pinhole camera sees of a triangle mesh. Images have the camera's size.
struct RasterImage {
  cv::Mat1f depth;        ///< z at the pixel centre [m]; 0: nothing
  cv::Mat1i triangle;     ///< index of the visible triangle; -1: nothing
  cv::Mat2f barycentric;  ///< perspective-correct weights of the triangle's first and second corner
  cv::Rect region;        ///< holds every covered pixel; may be a little larger
};

/// Renders by z-buffer, front and back faces alike; triangles that reach nearer than 1 cm to the camera plane
/// are left out. The image's memory is reused when the size fits. @throw std::invalid_argument if an index is
/// out of range.
void rasterize(const Pinhole& camera, const Points& vertices, const Triangles& triangles, RasterImage* image);

}  // namespace softbody
