#include "softbody_virtual_camera/rendering/visibility_buffer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody::virtual_camera {
namespace {

constexpr double kNearPlane = 0.01;      // [m]
constexpr double kEdgeTolerance = 1e-9;  // [px]; leaves no sample out between two triangles of an edge
constexpr int kBandRows = 16;            // rows of pixels

/// Horizontal edges do not bound a row.
void addEdge(const Eigen::Vector3d& p, const Eigen::Vector3d& q, bool front, ProjectedTriangle* t) {
  if (q.y() == p.y()) return;
  EdgeLine(&side)[2] = (q.y() > p.y()) == front ? t->left : t->right;
  const EdgeLine line{p.x(), p.y(), (q.x() - p.x()) / (q.y() - p.y())};
  const bool first = !std::isfinite(side[0].slope);
  side[1] = line;
  if (first) side[0] = line;
}

/// Image gradient of the barycentric coordinate of the corner opposite to `a` and `b`.
Eigen::Vector2d weightGradient(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double area) {
  return Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()) / area;
}

/// @param area twice the area of the triangle; negative if it faces the camera (v points down).
ProjectedTriangle triangleOf(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                             double area) {
  ProjectedTriangle t;
  const bool front = area < 0.0;
  addEdge(p, q, front, &t);
  addEdge(q, r, front, &t);
  addEdge(r, p, front, &t);
  const Eigen::Vector2d gradient =
      (q.z() - p.z()) * weightGradient(p, r, area) + (r.z() - p.z()) * weightGradient(q, p, area);
  t.inverse_z = {gradient.x(), gradient.y(), p.z() - gradient.dot(p.head<2>())};
  std::tie(t.min_u, t.max_u) = std::minmax({p.x(), q.x(), r.x()});
  std::tie(t.min_v, t.max_v) = std::minmax({p.y(), q.y(), r.y()});
  return t;
}

PixelWeights weightsOf(int index, const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                       const Eigen::Vector3d& r, double area) {
  PixelWeights w;
  w.index = index;
  w.front = area < 0.0;
  w.u = static_cast<float>(p.x());
  w.v = static_cast<float>(p.y());
  const Eigen::Vector2d second = weightGradient(p, r, area), third = weightGradient(q, p, area);
  const Eigen::Vector2d gradient = (q.z() - p.z()) * second + (r.z() - p.z()) * third;
  for (int k = 0; k < 2; ++k) {
    w.inverse_z[k] = static_cast<float>(gradient[k]);
    w.weight_by_z[0][k] = static_cast<float>(q.z() * second[k]);
    w.weight_by_z[1][k] = static_cast<float>(r.z() * third[k]);
  }
  w.inverse_z[2] = static_cast<float>(p.z());
  return w;
}

bool onImage(const ProjectedTriangle& t, const Pinhole& camera) {
  return t.max_u >= -0.5 && t.min_u <= camera.width - 0.5 && t.max_v >= -0.5 &&
         t.min_v <= camera.height - 0.5;
}

/// The pixels between two coordinates, and one more on the right, clipped to 0..size.
cv::Range pixelsOf(double low, double high, int size) {
  return {static_cast<int>(std::clamp<double>(std::floor(low), 0.0, size)),
          static_cast<int>(std::clamp<double>(std::floor(high) + 2.0, 0.0, size))};
}

void sortIntoBands(const Pinhole& camera, Projection* projection) {
  projection->bands.resize(static_cast<std::size_t>((camera.height + kBandRows - 1) / kBandRows));
  for (std::vector<int>& band : projection->bands) band.clear();
  projection->box = {};
  for (std::size_t i = 0; i < projection->triangles.size(); ++i) {
    const ProjectedTriangle& t = projection->triangles[i];
    const cv::Range columns = pixelsOf(t.min_u, t.max_u, camera.width);
    const cv::Range rows = pixelsOf(t.min_v, t.max_v, camera.height);
    if (columns.empty() || rows.empty()) continue;
    projection->box |= cv::Rect(columns.start, rows.start, columns.size(), rows.size());
    for (int band = rows.start / kBandRows; band <= (rows.end - 1) / kBandRows; ++band) {
      projection->bands[static_cast<std::size_t>(band)].push_back(static_cast<int>(i));
    }
  }
}

/// The first and the last sample of the row inside of all edges.
std::pair<int, int> span(const ProjectedTriangle& t, double v, const VisibilityBuffer& buffer) {
  const double low = std::max({t.min_u, t.left[0].at(v), t.left[1].at(v)});
  const double high = std::min({t.max_u, t.right[0].at(v), t.right[1].at(v)});
  if (!(high >= low - kEdgeTolerance)) return {0, -1};
  const auto sampleOf = [&](double u) { return (u + 0.5) * buffer.samples - 0.5; };
  const double last_column = buffer.triangle.cols - 1.0;
  // The cast rounds towards zero. For positive numbers this is a fast floor, hence the shift.
  const double first = std::clamp(sampleOf(low - kEdgeTolerance), 0.0, last_column + 1.0);
  const double last = std::clamp(sampleOf(high + kEdgeTolerance), -1.0, last_column);
  const int below = static_cast<int>(first);
  return {below < first ? below + 1 : below, static_cast<int>(last + 1.0) - 1};
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

void drawBand(const Projection& projection, const std::vector<int>& touching, int first_row, int last_row,
              VisibilityBuffer* buffer) {
  const auto rowOf = [&](double v) { return (v + 0.5) * buffer->samples - 0.5; };
  for (const int i : touching) {
    const ProjectedTriangle& t = projection.triangles[static_cast<std::size_t>(i)];
    const int begin = static_cast<int>(std::max<double>(first_row, rowOf(t.min_v)));
    const int end = static_cast<int>(std::min<double>(last_row, rowOf(t.max_v) + 1.0));
    for (int row = begin; row <= end; ++row) drawRow(t, i, row, buffer);
  }
}

}  // namespace

void project(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
             const std::vector<char>& one_sided, Projection* projection) {
  projection->vertices.resize(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const Eigen::Vector3d p = vertices.row(i);
    projection->vertices[static_cast<std::size_t>(i)] << camera.project(p), 1.0 / p.z();
  }
  projection->triangles.clear();
  projection->weights.clear();
  const auto tooNear = [](const Eigen::Vector3d& p) { return !(p.z() > 0.0 && p.z() <= 1.0 / kNearPlane); };
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const auto corner = [&](int k) -> const Eigen::Vector3d& {
      return projection->vertices[static_cast<std::size_t>(triangles(f, k))];
    };
    const Eigen::Vector3d &p = corner(0), &q = corner(1), &r = corner(2);
    const double area = (q.x() - p.x()) * (r.y() - p.y()) - (r.x() - p.x()) * (q.y() - p.y());
    if (one_sided[static_cast<std::size_t>(f)] && area >= 0.0) continue;
    if (std::abs(area) < 1e-12 || !std::isfinite(area) || tooNear(p) || tooNear(q) || tooNear(r)) continue;
    const ProjectedTriangle t = triangleOf(p, q, r, area);
    if (!onImage(t, camera)) continue;
    projection->triangles.push_back(t);
    projection->weights.push_back(weightsOf(static_cast<int>(f), p, q, r, area));
  }
  sortIntoBands(camera, projection);
}

void rasterize(const Projection& projection, int samples, const cv::Mat1f& behind, VisibilityBuffer* buffer) {
  buffer->samples = samples;
  buffer->inverse_z.create(behind.size());
  buffer->triangle.create(behind.size());
  const cv::Rect& box = projection.box;
  const cv::Range columns(box.x * samples, (box.x + box.width) * samples);
  cv::parallel_for_(cv::Range(0, static_cast<int>(projection.bands.size())), [&](const cv::Range& range) {
    for (int band = range.start; band < range.end; ++band) {
      const int first = std::max(band * kBandRows, box.y) * samples;
      const int end = std::min((band + 1) * kBandRows, box.y + box.height) * samples;
      if (first >= end) continue;
      const cv::Range rows(first, end);
      cv::Mat1f inverse_z = buffer->inverse_z(rows, columns);
      behind(rows, columns).copyTo(inverse_z);
      buffer->triangle(rows, columns).setTo(-1);
      drawBand(projection, projection.bands[static_cast<std::size_t>(band)], first, end - 1, buffer);
    }
  });
}

}  // namespace softbody::virtual_camera
