#include "softbody_evaluation/measures/cut_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::evaluation {
namespace {

constexpr double kSampleSpacing_m = 2e-3;

struct CutTriangle {
  Eigen::Vector3d a, b, c, normal;
  double area = 0.0;
};

std::vector<CutTriangle> cutTriangles(const MeshTopology& mesh) {
  std::vector<CutTriangle> triangles;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    if (!mesh.cut[static_cast<std::size_t>(f)]) continue;
    CutTriangle triangle;
    triangle.a = mesh.rest_vertices.row(mesh.triangles(f, 0));
    triangle.b = mesh.rest_vertices.row(mesh.triangles(f, 1));
    triangle.c = mesh.rest_vertices.row(mesh.triangles(f, 2));
    const Eigen::Vector3d cross = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
    triangle.area = 0.5 * cross.norm();
    triangle.normal = cross.normalized();
    if (triangle.area > 0.0) triangles.push_back(triangle);
  }
  return triangles;
}

/// A sample point of a triangle, and its part of the area.
struct Sample {
  Eigen::Vector3d point, normal;
  double area = 0.0;
};

/// The centres of n by n equal parts of every triangle.
std::vector<Sample> samples(const std::vector<CutTriangle>& triangles) {
  std::vector<Sample> all;
  for (const CutTriangle& t : triangles) {
    const int n = std::max(1, static_cast<int>(std::ceil(std::sqrt(2.0 * t.area) / kSampleSpacing_m)));
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 2 * (n - i) - 1; ++k) {
        // The parts of a row alternately point up and down; their centres are at 1/3 or 2/3 of the row.
        const int square = k / 2;
        const double row = (i + (k % 2 == 0 ? 1.0 : 2.0) / 3.0) / n;
        const double column = (square + (k % 2 == 0 ? 1.0 : 2.0) / 3.0) / n;
        all.push_back({t.a + row * (t.b - t.a) + column * (t.c - t.a), t.normal, t.area / (n * n)});
      }
    }
  }
  return all;
}

struct Nearest {
  const CutTriangle* triangle = nullptr;
  double distance = std::numeric_limits<double>::infinity();
};

Nearest nearestOf(const std::vector<CutTriangle>& triangles, const Eigen::Vector3d& point) {
  Nearest best;
  for (const CutTriangle& t : triangles) {
    const double distance = (nearestOnTriangle(point, t.a, t.b, t.c) - point).norm();
    if (distance < best.distance) best = {&t, distance};
  }
  return best;
}

double areaOf(const std::vector<CutTriangle>& triangles) {
  double area = 0.0;
  for (const CutTriangle& t : triangles) area += t.area;
  return area;
}

}  // namespace

CutSurfaceReport compareCutSurfaces(const MeshTopology& result, const MeshTopology& truth) {
  const std::vector<CutTriangle> mine = cutTriangles(result), its = cutTriangles(truth);
  CutSurfaceReport report;
  if (!its.empty()) report.area_ratio = areaOf(mine) / areaOf(its);
  if (mine.empty() || its.empty()) return report;
  std::vector<float> distances, missed, angles;
  // The axis of rotation from the true surface to the result's, with the sine of the angle as length. It is
  // equal for both sides of the cut.
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double projected = 0.0;
  for (const Sample& sample : samples(mine)) {
    const Nearest nearest = nearestOf(its, sample.point);
    const Eigen::Vector3d& axis = nearest.triangle->normal;
    const double cosine = sample.normal.dot(axis);
    distances.push_back(static_cast<float>(nearest.distance));
    angles.push_back(static_cast<float>(std::acos(std::min(1.0, std::abs(cosine)))));
    turn += sample.area * (cosine < 0.0 ? -1.0 : 1.0) * axis.cross(sample.normal);
    projected += sample.area * std::abs(cosine);
  }
  for (const Sample& sample : samples(its))
    missed.push_back(static_cast<float>(nearestOf(mine, sample.point).distance));
  report.tilt_rad = std::atan2(turn.norm(), projected);
  report.distance = summarize(std::move(distances));
  report.missed = summarize(std::move(missed));
  report.angle = summarize(std::move(angles));
  return report;
}

}  // namespace softbody::evaluation
