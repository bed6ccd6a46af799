#include "softbody_common/images/rasterizer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/hal/intrin.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace softbody {
namespace {

constexpr double kNearPlane = 0.01;  // [m]
// So that rounding leaves no pixel of a shared edge out of both triangles.
constexpr double kRounding = 1e-9;

using Corner = ProjectedVertex;

/// Twice the signed area of (a, b, p), in pixels.
double edge(const Corner& a, const Corner& b, double u, double v) {
  return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
}

int ceilOf(double x) {
  const int i = static_cast<int>(x);
  return i + static_cast<int>(x > i);
}

int floorOf(double x) {
  const int i = static_cast<int>(x);
  return i - static_cast<int>(x < i);
}

/// The integers from first to last.
struct Range {
  int first, last;
};

/// Pixel centres of a row or column between two coordinates, inside the image. Neither may be NaN.
Range centersBetween(double min, double max, int size) {
  if (max < -kRounding || min > size - 1.0 + kRounding) return {0, -1};
  return {ceilOf(std::max(0.0, min - kRounding)), floorOf(std::min(size - 1.0, max + kRounding))};
}

/// A linear function along a row of pixels.
struct Linear {
  double at_first, slope;
};

/// Clips the row to the part where the function is not negative.
void clip(const Linear& weight, double inverse_slope, double* first, double* last) {
  const double zero = (-kRounding - weight.at_first) * inverse_slope;
  if (weight.slope > 0.0) *first = std::max(*first, zero);
  if (weight.slope < 0.0) *last = std::min(*last, zero);
  if (weight.slope == 0.0 && weight.at_first < -kRounding) *last = -1.0;
}

void drawPixel(double inverse_z, int index, float* depth, int* triangle) {
  const auto z = static_cast<float>(1.0 / inverse_z);
  if (*depth != 0.0f && z >= *depth) return;
  *depth = z;
  *triangle = index;
}

constexpr int kFew = 4;           // pixels in a vector
constexpr double kSliver = 0.01;  // [px^2], twice the area below which the weights need double precision

/// A linear function at a row's first pixels.
cv::v_float32x4 atFirstFew(const Linear& function) {
  return cv::v_setall_f32(static_cast<float>(function.at_first)) +
         cv::v_float32x4(0.0f, 1.0f, 2.0f, 3.0f) * cv::v_setall_f32(static_cast<float>(function.slope));
}

/// Draws the next few pixels where it is allowed and nothing nearer is drawn.
inline void drawVector(const Linear& inverse_z, const cv::v_float32x4& allowed, const cv::v_int32x4& index,
                       float* depth, int* triangle) {
  const cv::v_float32x4 z = cv::v_setall_f32(1.0f) / atFirstFew(inverse_z), before = cv::v_load(depth);
  const cv::v_float32x4 drawn = allowed & ((before == cv::v_setzero_f32()) | (z < before));
  cv::v_store(depth, cv::v_select(drawn, z, before));
  cv::v_store(triangle, cv::v_select(cv::v_reinterpret_as_s32(drawn), index, cv::v_load(triangle)));
}

/// Draws pixels whose weights are known to be positive.
void drawSpan(const Linear& inverse_z, int first, int last, int index, float* depth, int* triangle) {
  const cv::v_int32x4 indices = cv::v_setall_s32(index);
  const cv::v_float32x4 all = cv::v_reinterpret_as_f32(cv::v_setall_s32(-1));
  int i = first;
  for (; i + kFew <= last + 1; i += kFew)
    drawVector({inverse_z.at_first + i * inverse_z.slope, inverse_z.slope}, all, indices, depth + i,
               triangle + i);
  for (; i <= last; ++i) drawPixel(inverse_z.at_first + i * inverse_z.slope, index, depth + i, triangle + i);
}

void drawFew(const Linear& weight0, const Linear& weight1, const Linear& inverse_z,
             const cv::v_int32x4& index, float* depth, int* triangle) {
  // The rounding error of single precision, so that no pixel of a shared edge is left out.
  const double rounding = 4e-7 * (1.0 + kFew * (std::abs(weight0.slope) + std::abs(weight1.slope)));
  const cv::v_float32x4 one = cv::v_setall_f32(1.0f);
  const cv::v_float32x4 w0 = atFirstFew(weight0), w1 = atFirstFew(weight1);
  const cv::v_float32x4 smallest = cv::v_min(cv::v_min(w0, w1), one - w0 - w1);
  drawVector(inverse_z, smallest >= cv::v_setall_f32(static_cast<float>(-rounding)), index, depth, triangle);
}

/// Draws a narrow triangle: one vector per row, without branches. Most triangles of a fine mesh are narrow.
void drawSmall(const Corner (&c)[3], double area, int column, const Range& rows, int index,
               RasterImage* image) {
  const double inverse_area = 1.0 / area;
  const double slope0 = (c[1].v - c[2].v) * inverse_area, slope1 = (c[2].v - c[0].v) * inverse_area;
  const double z0 = c[0].inverse_z - c[2].inverse_z, z1 = c[1].inverse_z - c[2].inverse_z;
  const cv::v_int32x4 indices = cv::v_setall_s32(index);
  for (int v = rows.first; v <= rows.last; ++v) {
    const double w0 = edge(c[1], c[2], column, v) * inverse_area;
    const double w1 = edge(c[2], c[0], column, v) * inverse_area;
    drawFew({w0, slope0}, {w1, slope1}, {w0 * z0 + w1 * z1 + c[2].inverse_z, slope0 * z0 + slope1 * z1},
            indices, image->depth[v] + column, image->triangle[v] + column);
  }
}

/// Draws row by row. The weights are linear along a row, so no test per pixel is needed.
void drawRows(const Corner (&c)[3], double area, const Range& columns, const Range& rows, int index,
              RasterImage* image) {
  const double inverse_area = 1.0 / area;
  const double slope0 = (c[1].v - c[2].v) * inverse_area, slope1 = (c[2].v - c[0].v) * inverse_area;
  const double slope2 = -slope0 - slope1;
  const double inverse0 = 1.0 / slope0, inverse1 = 1.0 / slope1, inverse2 = 1.0 / slope2;
  const double slope_z = slope0 * c[0].inverse_z + slope1 * c[1].inverse_z + slope2 * c[2].inverse_z;
  const int length = columns.last - columns.first;
  for (int v = rows.first; v <= rows.last; ++v) {
    const double w0 = edge(c[1], c[2], columns.first, v) * inverse_area;
    const double w1 = edge(c[2], c[0], columns.first, v) * inverse_area;
    const double w2 = 1.0 - w0 - w1;
    double first = 0.0, last = length;
    clip({w0, slope0}, inverse0, &first, &last);
    clip({w1, slope1}, inverse1, &first, &last);
    clip({w2, slope2}, inverse2, &first, &last);
    if (!(first <= last)) continue;
    const double inverse_z = w0 * c[0].inverse_z + w1 * c[1].inverse_z + w2 * c[2].inverse_z;
    drawSpan({inverse_z, slope_z}, ceilOf(first), floorOf(last), index, image->depth[v] + columns.first,
             image->triangle[v] + columns.first);
  }
}

/// Bounds of all pixels drawn so far.
struct Extent {
  int left = std::numeric_limits<int>::max(), top = left, right = -1, bottom = -1;

  void add(const Range& columns, const Range& rows) {
    left = std::min(left, columns.first), right = std::max(right, columns.last);
    top = std::min(top, rows.first), bottom = std::max(bottom, rows.last);
  }
  cv::Rect region() const {
    return right < 0 ? cv::Rect() : cv::Rect(left, top, right - left + 1, bottom - top + 1);
  }
};

void drawTriangle(const Corner (&c)[3], bool front_only, int index, RasterImage* image, Extent* extent) {
  const double area = edge(c[0], c[1], c[2].u, c[2].v);
  // Front faces have a negative area, because v points down.
  if (!(std::abs(area) <= std::numeric_limits<double>::max()) || area == 0.0 || (front_only && area > 0.0))
    return;
  const Range columns = centersBetween(std::min(std::min(c[0].u, c[1].u), c[2].u),
                                       std::max(std::max(c[0].u, c[1].u), c[2].u), image->depth.cols);
  const Range rows = centersBetween(std::min(std::min(c[0].v, c[1].v), c[2].v),
                                    std::max(std::max(c[0].v, c[1].v), c[2].v), image->depth.rows);
  if (columns.first > columns.last || rows.first > rows.last) return;
  extent->add(columns, rows);
  const bool small = columns.last - columns.first < kFew && columns.first + kFew <= image->depth.cols;
  if (small && std::abs(area) > kSliver) {
    drawSmall(c, area, columns.first, rows, index, image);
  } else {
    drawRows(c, area, columns, rows, index, image);
  }
}

void clear(const cv::Size& size, RasterImage* image) {
  if (image->depth.size() != size) {
    image->depth.create(size);
    image->triangle.create(size);
    image->region = cv::Rect(cv::Point(), size);
  }
  // Only the region of the last mesh is not clear.
  image->depth(image->region).setTo(0.0f);
  image->triangle(image->region).setTo(-1);
  image->region = cv::Rect();
}

/// Vertices that are too near get NaN.
void project(const Pinhole& camera, const Points& vertices, std::vector<ProjectedVertex>* projected) {
  projected->resize(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const double z = vertices(i, 2);
    const double inverse_z = z >= kNearPlane ? 1.0 / z : std::numeric_limits<double>::quiet_NaN();
    (*projected)[i] = {camera.fx * vertices(i, 0) * inverse_z + camera.cx,
                       camera.fy * vertices(i, 1) * inverse_z + camera.cy, inverse_z};
  }
}

}  // namespace

void rasterize(const Pinhole& camera, const Points& vertices, const Triangles& triangles, RasterImage* image,
               Faces faces) {
  clear(cv::Size(camera.width, camera.height), image);
  project(camera, vertices, &image->projected);
  const std::vector<ProjectedVertex>& corners = image->projected;
  Extent extent;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const auto a = static_cast<std::size_t>(triangles(f, 0)), b = static_cast<std::size_t>(triangles(f, 1)),
               c = static_cast<std::size_t>(triangles(f, 2));
    if (a >= corners.size() || b >= corners.size() || c >= corners.size()) {
      image->region = extent.region();
      throw std::invalid_argument("rasterize: a triangle has a vertex index above the number of vertices, " +
                                  std::to_string(corners.size()));
    }
    drawTriangle({corners[a], corners[b], corners[c]}, faces == Faces::kFront, static_cast<int>(f), image,
                 &extent);
  }
  image->region = extent.region();
}

Eigen::Vector3d rayWeights(const Pinhole& camera, const Eigen::Matrix3d& corners, double u, double v) {
  const Eigen::Vector3d ray = camera.unproject(u, v, 1.0);
  // The ray as a sum of the corners by Cramer's rule gives the weights up to scale.
  Eigen::Vector3d weights;
  for (int k = 0; k < 3; ++k) weights[k] = ray.dot(corners.col((k + 1) % 3).cross(corners.col((k + 2) % 3)));
  return weights / weights.sum();
}

Eigen::Vector3d rayWeights(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
                           int triangle, double u, double v) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = vertices.row(triangles(triangle, k));
  return rayWeights(camera, corners, u, v);
}

}  // namespace softbody
