#include "softbody_common/rasterizer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace softbody {
namespace {

constexpr double kNearPlane = 0.01;  // [m]
// Pixel centres on a shared edge must not fall between its two triangles by rounding.
constexpr double kRounding = 1e-9;

struct Corner {
  double u, v, inverse_z;
};

/// Twice the signed area of (a, b, p), in pixels.
double edge(const Corner& a, const Corner& b, double u, double v) {
  return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
}

void drawTriangle(const Corner (&c)[3], int index, RasterImage* image) {
  const double area = edge(c[0], c[1], c[2].u, c[2].v);
  if (area == 0.0 || !std::isfinite(area)) return;
  const auto [min_u, max_u] = std::minmax({c[0].u, c[1].u, c[2].u});
  const auto [min_v, max_v] = std::minmax({c[0].v, c[1].v, c[2].v});
  const int width = image->depth.cols, height = image->depth.rows;
  if (max_u < -kRounding || max_v < -kRounding || min_u > width - 1.0 + kRounding ||
      min_v > height - 1.0 + kRounding)
    return;
  const int first_u = static_cast<int>(std::ceil(std::max(0.0, min_u - kRounding)));
  const int last_u = static_cast<int>(std::floor(std::min(width - 1.0, max_u + kRounding)));
  const int first_v = static_cast<int>(std::ceil(std::max(0.0, min_v - kRounding)));
  const int last_v = static_cast<int>(std::floor(std::min(height - 1.0, max_v + kRounding)));
  for (int v = first_v; v <= last_v; ++v) {
    for (int u = first_u; u <= last_u; ++u) {
      const double w0 = edge(c[1], c[2], u, v) / area, w1 = edge(c[2], c[0], u, v) / area;
      const double w2 = 1.0 - w0 - w1;
      if (w0 < -kRounding || w1 < -kRounding || w2 < -kRounding) continue;
      const double inverse_z = w0 * c[0].inverse_z + w1 * c[1].inverse_z + w2 * c[2].inverse_z;
      const float z = static_cast<float>(1.0 / inverse_z);
      float& nearest = image->depth(v, u);
      if (nearest != 0.0f && z >= nearest) continue;
      nearest = z;
      image->triangle(v, u) = index;
      image->barycentric(v, u) = cv::Vec2f(static_cast<float>(w0 * c[0].inverse_z / inverse_z),
                                           static_cast<float>(w1 * c[1].inverse_z / inverse_z));
    }
  }
  if (first_u <= last_u && first_v <= last_v) {
    image->region |= cv::Rect(first_u, first_v, last_u - first_u + 1, last_v - first_v + 1);
  }
}

void clear(const cv::Size& size, RasterImage* image) {
  if (image->depth.size() != size) {
    image->depth.create(size);
    image->triangle.create(size);
    image->barycentric.create(size);
    image->region = cv::Rect(cv::Point(), size);
  }
  // Only what the last mesh covered needs wiping.
  image->depth(image->region).setTo(0.0f);
  image->triangle(image->region).setTo(-1);
  image->region = cv::Rect();
}

}  // namespace

void rasterize(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
               RasterImage* image) {
  if (triangles.size() != 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= vertices.rows())) {
    throw std::invalid_argument("rasterize: a triangle names a vertex beyond the " +
                                std::to_string(vertices.rows()) + " given");
  }
  clear(cv::Size(camera.width, camera.height), image);
  std::vector<Corner> corners(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const double z = vertices(i, 2);
    corners[i] = {camera.fx * vertices(i, 0) / z + camera.cx, camera.fy * vertices(i, 1) / z + camera.cy,
                  1.0 / z};
  }
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const int a = triangles(f, 0), b = triangles(f, 1), c = triangles(f, 2);
    const bool in_front =
        vertices(a, 2) >= kNearPlane && vertices(b, 2) >= kNearPlane && vertices(c, 2) >= kNearPlane;
    if (in_front) drawTriangle({corners[a], corners[b], corners[c]}, static_cast<int>(f), image);
  }
}

}  // namespace softbody
