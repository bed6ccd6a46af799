#include "softbody_bringup/virtual_camera/layer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody::virtual_camera {
namespace {

constexpr int kColorSamples = 2;            // by 2 a pixel
constexpr double kVisibilityMargin = 1e-3;  // [m]
const cv::Vec3b kBackground(40, 42, 45);

/// Every edge is used as often in one direction as in the other, and the outside is in front.
bool isClosed(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> edges, twins;
  double volume = 0.0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::RowVector3i t = mesh.triangles.row(f);
    for (int k = 0; k < 3; ++k) {
      edges.emplace_back(t[k], t[(k + 1) % 3]);
      twins.emplace_back(t[(k + 1) % 3], t[k]);
    }
    volume += mesh.vertices.row(t[0]).cross(mesh.vertices.row(t[1])).dot(mesh.vertices.row(t[2]));
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  return edges == twins && volume > 0.0;
}

/// Farthest depth of the pixels around (u, v) [m]; infinite where one of them sees nothing.
double farthestAround(const cv::Mat1f& inverse_z, double u, double v) {
  const int u0 = std::clamp(static_cast<int>(std::floor(u)), 0, inverse_z.cols - 2);
  const int v0 = std::clamp(static_cast<int>(std::floor(v)), 0, inverse_z.rows - 2);
  const float* above = inverse_z[v0] + u0;
  const float* below = inverse_z[v0 + 1] + u0;
  return 1.0 / std::min({above[0], above[1], below[0], below[1]});
}

}  // namespace

Canvas emptyCanvas(const Pinhole& camera) {
  const cv::Size size(camera.width, camera.height);
  return {cv::Mat3b(size, kBackground), cv::Mat1f(size * kColorSamples, 0.0f), cv::Mat1f(size, 0.0f)};
}

void Layer::add(const Actor& actor) {
  const Eigen::Index first_vertex = vertices_.rows(), first_triangle = triangles_.rows();
  vertices_.conservativeResize(first_vertex + actor.rest.vertices.rows(), 3);
  triangles_.conservativeResize(first_triangle + actor.rest.triangles.rows(), 3);
  triangles_.bottomRows(actor.rest.triangles.rows()) =
      actor.rest.triangles.array() + static_cast<int>(first_vertex);
  one_sided_.resize(static_cast<std::size_t>(triangles_.rows()), isClosed(actor.rest));
  shading_.add(actor.rest, actor.crease_angle_rad);
  texture_.add(actor.rest, actor.texture, actor.skin, actor.texel_m);
}

void Layer::place(const std::vector<const Points*>& vertices, const Eigen::Vector3d& to_light) {
  Eigen::Index row = 0;
  for (const Points* actor : vertices) {
    vertices_.middleRows(row, actor->rows()) = *actor;
    row += actor->rows();
  }
  project(camera_, vertices_, triangles_, one_sided_, &projection_);
  shading_.light(vertices_, triangles_, to_light);
}

void Layer::drawColor(const Canvas& behind, cv::Mat3b* color) {
  rasterize(projection_, kColorSamples, behind.fine, &color_samples_);
  behind.color.copyTo(*color);
  const cv::Rect& box = projection_.box;
  cv::parallel_for_(cv::Range(box.y, box.y + box.height), [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      for (int u = box.x; u < box.x + box.width; ++u) {
        const cv::Vec3f c = pixelColor(behind.color(v, u), u, v);
        (*color)(v, u) = cv::Vec3b(cv::saturate_cast<uchar>(c[0]), cv::saturate_cast<uchar>(c[1]),
                                   cv::saturate_cast<uchar>(c[2]));
      }
    }
  });
}

void Layer::drawDepth(const Canvas& behind, cv::Mat1f* inverse_z) {
  rasterize(projection_, 1, behind.inverse_z, &depth_samples_);
  behind.inverse_z.copyTo(*inverse_z);
  if (!projection_.box.empty()) {
    depth_samples_.inverse_z(projection_.box).copyTo((*inverse_z)(projection_.box));
  }
}

Canvas Layer::draw(const Canvas& behind) {
  Canvas canvas;
  drawColor(behind, &canvas.color);
  behind.fine.copyTo(canvas.fine);
  const cv::Rect& box = projection_.box;
  drawDepth(behind, &canvas.inverse_z);
  if (box.empty()) return canvas;
  const cv::Rect fine(box.tl() * kColorSamples, box.size() * kColorSamples);
  color_samples_.inverse_z(fine).copyTo(canvas.fine(fine));
  return canvas;
}

std::vector<float> Layer::visibility(int count, const cv::Mat1f& inverse_z) const {
  std::vector<char> faces_camera(static_cast<std::size_t>(vertices_.rows()), 0);
  for (const ProjectedTriangle& t : projection_.triangles) {
    for (int k = 0; k < 3; ++k) faces_camera[static_cast<std::size_t>(triangles_(t.index, k))] |= t.front;
  }
  std::vector<float> visibility(static_cast<std::size_t>(count), 0.0f);
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const Eigen::Vector3d& p = projection_.vertices[i];
    const bool seen = faces_camera[i] && camera_.contains(p.x(), p.y()) &&
                      1.0 / p.z() <= farthestAround(inverse_z, p.x(), p.y()) + kVisibilityMargin;
    visibility[i] = seen ? 1.0f : 0.0f;
  }
  return visibility;
}

cv::Vec3f Layer::colorAt(const ProjectedTriangle& t, double u, double v) const {
  const double z = 1.0 / t.inverse_z(u, v);
  const float w1 = static_cast<float>(t.weight_by_z[0](u, v) * z),
              w2 = static_cast<float>(t.weight_by_z[1](u, v) * z);
  const float b0 = shading_.at(t.index, 0);
  return (b0 + w1 * (shading_.at(t.index, 1) - b0) + w2 * (shading_.at(t.index, 2) - b0)) *
         texture_.at(t.index, w1, w2);
}

cv::Vec3f Layer::pixelColor(const cv::Vec3b& behind, int u, int v) const {
  const VisibilityBuffer& samples = color_samples_;
  const int* above = samples.triangle[2 * v] + 2 * u;
  const int* below = samples.triangle[2 * v + 1] + 2 * u;
  const int seen[4] = {above[0], above[1], below[0], below[1]};
  if (seen[1] == seen[0] && seen[2] == seen[0] && seen[3] == seen[0]) {
    if (seen[0] < 0) return behind;
    // Texels that are larger than the pixel cannot alias: one sample is enough.
    const ProjectedTriangle& t = projection_.triangles[static_cast<std::size_t>(seen[0])];
    if (texture_.texel(t.index) * camera_.fx * samples.inverse_z(2 * v, 2 * u) > 1.0) return colorAt(t, u, v);
  }
  cv::Vec3f sum(0.0f, 0.0f, 0.0f);
  for (int i = 0; i < 4; ++i) {
    const double sample_u = samples.pixelOf(2 * u + i % 2), sample_v = samples.pixelOf(2 * v + i / 2);
    sum += seen[i] < 0
               ? cv::Vec3f(behind)
               : colorAt(projection_.triangles[static_cast<std::size_t>(seen[i])], sample_u, sample_v);
  }
  return 0.25f * sum;
}

}  // namespace softbody::virtual_camera
