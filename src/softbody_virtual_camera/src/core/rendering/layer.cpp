#include "softbody_virtual_camera/rendering/layer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/images/pixel_labels.h"

namespace softbody::virtual_camera {
namespace {

constexpr int kColorSamples = 2;            // per pixel, in each direction
constexpr int kAhead = 12;                  // number of prefetched pixels
constexpr double kVisibilityMargin = 1e-3;  // [m]
const cv::Vec3b kBackground(40, 42, 45);

/// Whether the mesh is closed and oriented outward.
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

cv::Vec3b toColor(const cv::v_float32x4& color) {
  const cv::v_int32x4 rounded = cv::v_round(color);
  cv::Vec4b bytes;
  cv::v_pack_store(bytes.val, cv::v_pack_u(rounded, rounded));
  return {bytes[0], bytes[1], bytes[2]};
}

/// The largest depth of the pixels around (u, v) [m]; infinite if one of them is empty.
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

void Layer::add(const Actor& actor, std::uint8_t label) {
  const Eigen::Index first_vertex = vertices_.rows(), first_triangle = triangles_.rows();
  vertices_.conservativeResize(first_vertex + actor.rest.vertices.rows(), 3);
  triangles_.conservativeResize(first_triangle + actor.rest.triangles.rows(), 3);
  triangles_.bottomRows(actor.rest.triangles.rows()) =
      actor.rest.triangles.array() + static_cast<int>(first_vertex);
  one_sided_.resize(static_cast<std::size_t>(triangles_.rows()), isClosed(actor.rest));
  labels_.resize(static_cast<std::size_t>(triangles_.rows()), label);
  shading_.add(actor.rest, actor.crease_angle_rad);
  texture_.add(actor.rest, actor.texture, actor.skin, actor.texel_m);
}

void Layer::place(const std::vector<const Points*>& vertices, const Lights& lights) {
  Eigen::Index row = 0;
  for (const Points* actor : vertices) {
    vertices_.middleRows(row, actor->rows()) = *actor;
    row += actor->rows();
  }
  project(camera_, vertices_, triangles_, one_sided_, &projection_);
  shading_.light(vertices_, triangles_, lights);
  for (PixelWeights& t : projection_.weights) {
    for (int k = 0; k < 3; ++k) t.brightness[k] = shading_.at(t.index, k);
  }
}

void Layer::drawColor(const Canvas& behind, cv::Mat3b* color) {
  rasterize(projection_, kColorSamples, behind.fine, &color_samples_);
  behind.color.copyTo(*color);
  const cv::Rect& box = projection_.box;
  cv::parallel_for_(cv::Range(box.y, box.y + box.height), [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      for (int u = box.x; u < box.x + box.width; ++u) {
        prefetch(u + kAhead, v);
        (*color)(v, u) = pixelColor(behind.color(v, u), u, v);
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

void Layer::drawLabels(cv::Mat1b* labels) const {
  labels->create(depth_samples_.triangle.size());
  labels->setTo(labels::kBackground);
  const cv::Rect& box = projection_.box;
  for (int v = box.y; v < box.y + box.height; ++v) {
    for (int u = box.x; u < box.x + box.width; ++u) {
      const int seen = depth_samples_.triangle(v, u);
      if (seen < 0) continue;
      const int triangle = projection_.weights[static_cast<std::size_t>(seen)].index;
      (*labels)(v, u) = labels_[static_cast<std::size_t>(triangle)];
    }
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

std::vector<float> Layer::visibility(int first, int count, const cv::Mat1f& inverse_z) const {
  std::vector<char> faces_camera(static_cast<std::size_t>(vertices_.rows()), 0);
  for (const PixelWeights& t : projection_.weights) {
    for (int k = 0; k < 3; ++k) faces_camera[static_cast<std::size_t>(triangles_(t.index, k))] |= t.front;
  }
  std::vector<float> visibility(static_cast<std::size_t>(count), 0.0f);
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const std::size_t vertex = static_cast<std::size_t>(first) + i;
    const Eigen::Vector3d& p = projection_.vertices[vertex];
    const bool seen = faces_camera[vertex] && camera_.contains(p.x(), p.y()) &&
                      1.0 / p.z() <= farthestAround(inverse_z, p.x(), p.y()) + kVisibilityMargin;
    visibility[i] = seen ? 1.0f : 0.0f;
  }
  return visibility;
}

cv::v_float32x4 Layer::colorAt(const PixelWeights& t, float u, float v) const {
  const float du = u - t.u, dv = v - t.v;
  const float z = 1.0f / (t.inverse_z[0] * du + t.inverse_z[1] * dv + t.inverse_z[2]);
  const float w1 = z * (t.weight_by_z[0][0] * du + t.weight_by_z[0][1] * dv),
              w2 = z * (t.weight_by_z[1][0] * du + t.weight_by_z[1][1] * dv);
  const float brightness =
      t.brightness[0] + w1 * (t.brightness[1] - t.brightness[0]) + w2 * (t.brightness[2] - t.brightness[0]);
  return cv::v_setall_f32(brightness) * texture_.at(t.index, w1, w2);
}

void Layer::prefetch(int u, int v) const {
  if (u >= projection_.box.x + projection_.box.width) return;
  const int* seen = &color_samples_.triangle(2 * v, 2 * u);
  if (seen[0] < 0 || seen[0] == seen[-1]) return;
  texture_.prefetch(projection_.weights[static_cast<std::size_t>(seen[0])].index);
}

cv::Vec3b Layer::pixelColor(const cv::Vec3b& behind, int u, int v) const {
  const VisibilityBuffer& samples = color_samples_;
  const int* above = &samples.triangle(2 * v, 2 * u);
  const int* below = &samples.triangle(2 * v + 1, 2 * u);
  const int seen[4] = {above[0], above[1], below[0], below[1]};
  if (seen[1] == seen[0] && seen[2] == seen[0] && seen[3] == seen[0]) {
    if (seen[0] < 0) return behind;
    // Texels larger than the pixel cannot alias, so one sample is enough.
    const PixelWeights& t = projection_.weights[static_cast<std::size_t>(seen[0])];
    if (texture_.texel(t.index) * camera_.fx * samples.inverse_z(2 * v, 2 * u) > 1.0)
      return toColor(colorAt(t, static_cast<float>(u), static_cast<float>(v)));
  }
  const cv::v_float32x4 nothing(behind[0], behind[1], behind[2], 0.0f);
  cv::v_float32x4 sum = cv::v_setzero_f32();
  for (int i = 0; i < 4; ++i) {
    const float sample_u = static_cast<float>(u) + (i % 2 == 0 ? -0.25f : 0.25f),
                sample_v = static_cast<float>(v) + (i / 2 == 0 ? -0.25f : 0.25f);
    sum += seen[i] < 0 ? nothing
                       : colorAt(projection_.weights[static_cast<std::size_t>(seen[i])], sample_u, sample_v);
  }
  return toColor(cv::v_setall_f32(0.25f) * sum);
}

}  // namespace softbody::virtual_camera
