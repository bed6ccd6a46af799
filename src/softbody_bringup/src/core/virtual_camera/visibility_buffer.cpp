#include "softbody_bringup/virtual_camera/visibility_buffer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody::virtual_camera {
namespace {

constexpr double kNearPlane = 0.01;      // [m]
constexpr double kEdgeTolerance = 1e-9;  // [px]; no sample may fall between two triangles of one edge
constexpr int kBandRows = 16;            // of pixels

ProjectedTriangle project(const Eigen::Vector3d (&corner)[3]) {
  ProjectedTriangle t;
  const Eigen::Matrix3d inverse_z = Eigen::Vector3d(corner[0].z(), corner[1].z(), corner[2].z()).asDiagonal();
  Eigen::Matrix3d places;
  for (int k = 0; k < 3; ++k) places.col(k) << corner[k].x(), corner[k].y(), 1.0;
  const double area = places.determinant();
  if (std::abs(area) < 1e-12 || !std::isfinite(area)) return t;
  // Rows of the inverse take (u, v, 1) to the barycentric coordinates.
  const Eigen::Matrix3d weights = places.inverse();
  const Eigen::Matrix3d by_z = inverse_z * weights;
  const auto affine = [](const Eigen::RowVector3d& row) { return Affine{row[0], row[1], row[2]}; };
  for (int k = 0; k < 3; ++k) t.weight[k] = affine(weights.row(k));
  t.inverse_z = affine(by_z.colwise().sum());
  t.weight_by_z[0] = affine(by_z.row(1));
  t.weight_by_z[1] = affine(by_z.row(2));
  std::tie(t.min_u, t.max_u) = std::minmax({corner[0].x(), corner[1].x(), corner[2].x()});
  std::tie(t.min_v, t.max_v) = std::minmax({corner[0].y(), corner[1].y(), corner[2].y()});
  t.drawable = true;
  t.front = area < 0.0;  // v grows downwards
  return t;
}

/// First and last sample of the row whose weights are all above zero.
std::pair<int, int> span(const ProjectedTriangle& t, double v, const VisibilityBuffer& buffer) {
  double low = t.min_u, high = t.max_u;
  for (const Affine& w : t.weight) {
    const double rest = w.b * v + w.c;
    if (w.a > 0.0) {
      low = std::max(low, -rest / w.a);
    } else if (w.a < 0.0) {
      high = std::min(high, -rest / w.a);
    } else if (rest < 0.0) {
      return {0, -1};
    }
  }
  const auto sampleOf = [&](double u) { return (u + 0.5) * buffer.samples - 0.5; };
  const double last_column = buffer.triangle.cols - 1.0;
  if (high < low - kEdgeTolerance) return {0, -1};
  return {static_cast<int>(std::ceil(std::clamp(sampleOf(low - kEdgeTolerance), 0.0, last_column + 1.0))),
          static_cast<int>(std::floor(std::clamp(sampleOf(high + kEdgeTolerance), -1.0, last_column)))};
}

void drawRow(const ProjectedTriangle& t, int index, int row, VisibilityBuffer* buffer) {
  const double v = buffer->pixelOf(row);
  if (v < t.min_v || v > t.max_v) return;
  const auto [first, last] = span(t, v, *buffer);
  float* nearest = buffer->inverse_z[row];
  int* triangle = buffer->triangle[row];
  const double step = t.inverse_z.a / buffer->samples;
  const double start = t.inverse_z(buffer->pixelOf(0), v);
  for (int i = first; i <= last; ++i) {
    const float inverse_z = static_cast<float>(start + step * i);
    if (inverse_z <= nearest[i]) continue;
    nearest[i] = inverse_z;
    triangle[i] = index;
  }
}

void drawBand(const std::vector<ProjectedTriangle>& triangles, int first_row, int last_row,
              VisibilityBuffer* buffer) {
  const double top = buffer->pixelOf(first_row), bottom = buffer->pixelOf(last_row);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const ProjectedTriangle& t = triangles[f];
    if (!t.drawable || t.max_v < top || t.min_v > bottom) continue;
    const auto rowOf = [&](double v) { return (v + 0.5) * buffer->samples - 0.5; };
    const int begin = std::max(first_row, static_cast<int>(std::max(0.0, std::floor(rowOf(t.min_v)))));
    const int end = std::min<double>(last_row, std::ceil(rowOf(t.max_v)));
    for (int row = begin; row <= end; ++row) drawRow(t, static_cast<int>(f), row, buffer);
  }
}

}  // namespace

std::vector<ProjectedTriangle> projectTriangles(const Pinhole& camera, const Points& vertices,
                                                const Triangles& triangles) {
  std::vector<ProjectedTriangle> projected(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Eigen::Vector3d corner[3];
    bool in_front = true;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = vertices.row(triangles(f, k));
      in_front = in_front && p.z() >= kNearPlane;
      corner[k] << camera.project(p), 1.0 / p.z();
    }
    if (in_front) projected[static_cast<std::size_t>(f)] = project(corner);
  }
  return projected;
}

void rasterize(const Pinhole& camera, const std::vector<ProjectedTriangle>& triangles, int samples,
               VisibilityBuffer* buffer) {
  buffer->samples = samples;
  buffer->inverse_z.create(camera.height * samples, camera.width * samples);
  buffer->triangle.create(camera.height * samples, camera.width * samples);
  const int bands = (camera.height + kBandRows - 1) / kBandRows;
  cv::parallel_for_(cv::Range(0, bands), [&](const cv::Range& range) {
    for (int band = range.start; band < range.end; ++band) {
      const int first = band * kBandRows * samples;
      const int last = std::min((band + 1) * kBandRows, camera.height) * samples - 1;
      buffer->inverse_z.rowRange(first, last + 1).setTo(0.0f);
      buffer->triangle.rowRange(first, last + 1).setTo(-1);
      drawBand(triangles, first, last, buffer);
    }
  });
}

}  // namespace softbody::virtual_camera
