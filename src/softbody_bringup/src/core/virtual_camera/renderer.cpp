#include "softbody_bringup/virtual_camera/renderer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody::virtual_camera {
namespace {

constexpr int kColorSamples = 2;            // by 2 a pixel
constexpr float kAmbient = 0.40f;           // share of the light that comes from everywhere
constexpr double kVisibilityMargin = 1e-3;  // [m]
const cv::Vec3f kBackground(40.0f, 42.0f, 45.0f);

/// Normals with the length of twice the triangles' areas.
Points areaNormals(const Points& vertices, const Triangles& triangles) {
  Points normals(triangles.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::Vector3d a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                          c = vertices.row(triangles(f, 2));
    normals.row(f) = (b - a).cross(c - a);
  }
  return normals;
}

/// For every corner (3 f + k) the triangles around its vertex that are less than the crease angle from f at
/// rest.
std::vector<std::vector<int>> smoothNeighbors(const TriangleMesh& rest, double crease_angle_rad) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(rest.vertices.rows()));
  for (Eigen::Index f = 0; f < rest.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      around[static_cast<std::size_t>(rest.triangles(f, k))].push_back(static_cast<int>(f));
  }
  const Points normals = areaNormals(rest.vertices, rest.triangles).rowwise().normalized();
  const double least_cosine = std::cos(crease_angle_rad);
  std::vector<std::vector<int>> neighbors;
  for (Eigen::Index f = 0; f < rest.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      neighbors.emplace_back();
      for (const int g : around[static_cast<std::size_t>(rest.triangles(f, k))]) {
        if (normals.row(f).dot(normals.row(g)) >= least_cosine) neighbors.back().push_back(g);
      }
    }
  }
  return neighbors;
}

std::vector<float> cornerBrightness(const Points& normals, const std::vector<std::vector<int>>& neighbors,
                                    const Eigen::Vector3d& to_light) {
  std::vector<float> brightness;
  brightness.reserve(neighbors.size());
  for (const std::vector<int>& triangles : neighbors) {
    Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
    for (const int f : triangles) normal += normals.row(f);
    const float diffuse = static_cast<float>(std::max(0.0, normal.normalized().dot(to_light)));
    brightness.push_back(kAmbient + (1.0f - kAmbient) * diffuse);
  }
  return brightness;
}

/// Farthest depth of the pixels around (u, v) [m]; infinite where one of them sees nothing.
double farthestAround(const VisibilityBuffer& buffer, double u, double v) {
  const int u0 = std::clamp(static_cast<int>(std::floor(u)), 0, buffer.triangle.cols - 2);
  const int v0 = std::clamp(static_cast<int>(std::floor(v)), 0, buffer.triangle.rows - 2);
  float least = buffer.inverse_z(v0, u0);
  for (const auto& [dv, du] : {std::pair(0, 1), std::pair(1, 0), std::pair(1, 1)}) {
    least = std::min(least, buffer.inverse_z(v0 + dv, u0 + du));
  }
  return 1.0 / least;
}

/// A vertex is seen if a triangle at it faces the camera and nothing lies before it in the z-buffer.
std::vector<float> vertexVisibility(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
                                    const std::vector<ProjectedTriangle>& projected,
                                    const VisibilityBuffer& buffer, int count) {
  std::vector<float> visibility(static_cast<std::size_t>(count), 0.0f);
  for (std::size_t f = 0; f < projected.size(); ++f) {
    if (!projected[f].drawable || !projected[f].front) continue;
    for (int k = 0; k < 3; ++k) {
      const int i = triangles(static_cast<Eigen::Index>(f), k);
      if (i >= count) continue;
      const Eigen::Vector3d p = vertices.row(i);
      const Eigen::Vector2d pixel = camera.project(p);
      const bool seen = camera.contains(pixel.x(), pixel.y()) &&
                        p.z() <= farthestAround(buffer, pixel.x(), pixel.y()) + kVisibilityMargin;
      visibility[static_cast<std::size_t>(i)] = seen ? 1.0f : 0.0f;
    }
  }
  return visibility;
}

}  // namespace

Renderer::Renderer(const Scene& scene, const Pinhole& camera)
    : camera_(camera),
      to_light_(scene.to_light),
      body_vertices_(static_cast<int>(scene.actors.at(0).rest.vertices.rows())) {
  for (const Actor& actor : scene.actors) {
    const int first_vertex = static_cast<int>(vertices_.rows()),
              first_triangle = static_cast<int>(triangles_.rows());
    vertices_.conservativeResize(first_vertex + actor.rest.vertices.rows(), 3);
    triangles_.conservativeResize(first_triangle + actor.rest.triangles.rows(), 3);
    triangles_.bottomRows(actor.rest.triangles.rows()) = actor.rest.triangles.array() + first_vertex;
    for (std::vector<int>& neighbors : smoothNeighbors(actor.rest, actor.crease_angle_rad)) {
      for (int& f : neighbors) f += first_triangle;
      smooth_neighbors_.push_back(std::move(neighbors));
    }
    texture_.add(actor.rest, actor.texture, actor.skin, actor.texel_m);
  }
}

void Renderer::renderColor(const std::vector<Points>& vertices, cv::Mat3b* color) {
  gather(vertices);
  projected_ = projectTriangles(camera_, vertices_, triangles_);
  brightness_ = cornerBrightness(areaNormals(vertices_, triangles_), smooth_neighbors_, to_light_);
  rasterize(camera_, projected_, kColorSamples, &color_samples_);
  shade(color);
}

void Renderer::render(const std::vector<Points>& vertices, RenderedImage* image) {
  renderColor(vertices, &image->color);
  rasterize(camera_, projected_, 1, &depth_samples_);
  image->depth.create(camera_.height, camera_.width);
  std::transform(depth_samples_.inverse_z.begin(), depth_samples_.inverse_z.end(), image->depth.begin(),
                 [](float inverse_z) { return inverse_z > 0.0f ? 1.0f / inverse_z : 0.0f; });
  image->visibility =
      vertexVisibility(camera_, vertices_, triangles_, projected_, depth_samples_, body_vertices_);
}

void Renderer::gather(const std::vector<Points>& vertices) {
  Eigen::Index row = 0;
  for (const Points& actor : vertices) {
    vertices_.middleRows(row, actor.rows()) = actor;
    row += actor.rows();
  }
}

cv::Vec3f Renderer::colorAt(int triangle, double u, double v) const {
  const ProjectedTriangle& t = projected_[static_cast<std::size_t>(triangle)];
  const double z = 1.0 / t.inverse_z(u, v);
  const float w1 = static_cast<float>(t.weight_by_z[0](u, v) * z),
              w2 = static_cast<float>(t.weight_by_z[1](u, v) * z);
  const float* b = &brightness_[3 * static_cast<std::size_t>(triangle)];
  return (b[0] + w1 * (b[1] - b[0]) + w2 * (b[2] - b[0])) * texture_.at(triangle, w1, w2);
}

cv::Vec3f Renderer::pixelColor(int u, int v) const {
  const VisibilityBuffer& samples = color_samples_;
  const int* above = samples.triangle[2 * v] + 2 * u;
  const int* below = samples.triangle[2 * v + 1] + 2 * u;
  const int triangles[4] = {above[0], above[1], below[0], below[1]};
  const bool uniform =
      triangles[1] == triangles[0] && triangles[2] == triangles[0] && triangles[3] == triangles[0];
  if (uniform && triangles[0] < 0) return kBackground;
  // Texels that are larger than the pixel cannot alias: one sample is enough.
  if (uniform && texture_.texel(triangles[0]) * camera_.fx * samples.inverse_z(2 * v, 2 * u) > 1.0) {
    return colorAt(triangles[0], u, v);
  }
  cv::Vec3f sum(0.0f, 0.0f, 0.0f);
  for (int i = 0; i < 4; ++i) {
    const double sample_u = samples.pixelOf(2 * u + i % 2), sample_v = samples.pixelOf(2 * v + i / 2);
    sum += triangles[i] < 0 ? kBackground : colorAt(triangles[i], sample_u, sample_v);
  }
  return 0.25f * sum;
}

void Renderer::shade(cv::Mat3b* color) const {
  color->create(camera_.height, camera_.width);
  cv::parallel_for_(cv::Range(0, camera_.height), [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const cv::Vec3f c = pixelColor(u, v);
        (*color)(v, u) = cv::Vec3b(cv::saturate_cast<uchar>(c[0]), cv::saturate_cast<uchar>(c[1]),
                                   cv::saturate_cast<uchar>(c[2]));
      }
    }
  });
}

}  // namespace softbody::virtual_camera
