#pragma once

#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// The function a u + b v + c of a pixel (u, v).
struct Affine {
  double a = 0.0, b = 0.0, c = 0.0;
  double operator()(double u, double v) const { return a * u + b * v + c; }
};

/// The line of an edge in the image.
struct EdgeLine {
  double u = 0.0, v = 0.0;                                  ///< a point of the line [px]
  double slope = std::numeric_limits<double>::quiet_NaN();  ///< du / dv
  double at(double row) const { return u + slope * (row - v); }
};

/// A triangle in the image plane.
struct ProjectedTriangle {
  EdgeLine left[2], right[2];  ///< its edges on the left and the right side; a single edge is in both entries
  Affine inverse_z;            ///< 1 / z [1/m]
  double min_u = 0.0, max_u = 0.0, min_v = 0.0, max_v = 0.0;
};

/// Barycentric weights at the pixels of a triangle, relative to its first corner, in single precision.
struct PixelWeights {
  int index = 0;             ///< of the triangle in the mesh
  bool front = false;        ///< its counter-clockwise side faces the camera
  float u = 0.0f, v = 0.0f;  ///< the first corner [px]
  float inverse_z[3];        ///< a, b, c of 1 / z = a du + b dv + c [1/m]
  float weight_by_z[2][2];   ///< a, b of the barycentric coordinate / z of the second and the third corner
  float brightness[3] = {};  ///< at the corners, 0..1
};

/// The part of a mesh that can be visible in the image.
struct Projection {
  std::vector<Eigen::Vector3d> vertices;     ///< u, v [px], 1 / z [1/m]
  std::vector<ProjectedTriangle> triangles;  ///< in front of the camera, in the image, not edge-on
  std::vector<PixelWeights> weights;         ///< of the same triangles
  std::vector<std::vector<int>> bands;       ///< per band of rows: the triangles that touch it, in order
  cv::Rect box;                              ///< contains all pixels of the triangles
};

/// @param vertices in the camera's frame [m]. Triangles with a corner nearer than 1 cm are left out.
/// @param one_sided per triangle: leave it out if its back faces the camera.
void project(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
             const std::vector<char>& one_sided, Projection* projection);

/// The nearest triangle at every sample. Samples are a regular grid, `samples` by `samples` per pixel. Only
/// samples in the projection's box are valid.
struct VisibilityBuffer {
  int samples = 1;
  cv::Mat1f inverse_z;  ///< [1/m]; 0: nothing
  cv::Mat1i triangle;   ///< index in the projection; -1: the background

  /// Pixel coordinate of a sample's row or column; with one sample per pixel it is the pixel's centre.
  double pixelOf(int sample) const { return (sample + 0.5) / samples - 0.5; }
};

/// Rasterises bands of rows in parallel. The result does not depend on the number of threads.
/// @param behind inverse z of the background at the samples, of the size of the result.
void rasterize(const Projection& projection, int samples, const cv::Mat1f& behind, VisibilityBuffer* buffer);

}  // namespace softbody::virtual_camera
