#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// a u + b v + c.
struct Affine {
  double a = 0.0, b = 0.0, c = 0.0;
  double operator()(double u, double v) const { return a * u + b * v + c; }
};

/// A triangle on the image plane. All its functions are affine in the pixel coordinates.
struct ProjectedTriangle {
  Affine weight[3];       ///< screen-space barycentric coordinates
  Affine inverse_z;       ///< 1 / z [1/m]
  Affine weight_by_z[2];  ///< weight / z of the second and the third corner
  double min_u = 0.0, max_u = 0.0, min_v = 0.0, max_v = 0.0;
  bool drawable = false;  ///< in front of the camera and not edge-on
  bool front = false;     ///< its counter-clockwise side faces the camera
};

/// @param vertices in the camera's frame [m]. Triangles nearer than 1 cm are not drawable.
std::vector<ProjectedTriangle> projectTriangles(const Pinhole& camera, const Points& vertices,
                                                const Triangles& triangles);

/// The nearest triangle at every sample; samples lie on a regular grid, `samples` by `samples` in a pixel.
struct VisibilityBuffer {
  int samples = 1;
  cv::Mat1f inverse_z;  ///< [1/m]; 0: nothing
  cv::Mat1i triangle;   ///< -1: nothing

  /// Pixel coordinate of a sample's row or column; for one sample a pixel it is the pixel's centre.
  double pixelOf(int sample) const { return (sample + 0.5) / samples - 0.5; }
};

/// Rasterises in parallel bands of rows; the result does not depend on the number of threads.
void rasterize(const Pinhole& camera, const std::vector<ProjectedTriangle>& triangles, int samples,
               VisibilityBuffer* buffer);

}  // namespace softbody::virtual_camera
