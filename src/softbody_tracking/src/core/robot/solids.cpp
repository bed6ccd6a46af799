#include "robot/solids.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace softbody {
namespace {

constexpr double kSag_m = 0.0005;   // of a chord: a sixth of a link's usual deviation
constexpr double kSagShare = 0.01;  // of the radius: large wheels need no more corners

int cornersOfCircle(double radius) {
  const double sag = std::max(kSag_m / radius, kSagShare);
  return sag >= 0.5 ? 6 : std::max(6, static_cast<int>(std::ceil(M_PI / std::acos(1.0 - sag))));
}

/// Rings of equally many points about the z axis between two poles.
TriangleMesh turned(const std::vector<Eigen::Vector2d>& profile, int corners) {
  const int rings = static_cast<int>(profile.size()) - 2;
  TriangleMesh mesh{Points(2 + rings * corners, 3), Triangles(2 * rings * corners, 3)};
  mesh.vertices.row(0) << 0.0, 0.0, profile.front().y();
  mesh.vertices.row(1) << 0.0, 0.0, profile.back().y();
  int triangle = 0;
  const auto vertex = [&](int ring, int k) { return 2 + ring * corners + k % corners; };
  for (int ring = 0; ring < rings; ++ring) {
    const Eigen::Vector2d& at = profile[ring + 1];
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * M_PI * k / corners;
      mesh.vertices.row(vertex(ring, k)) << at.x() * std::cos(angle), at.x() * std::sin(angle), at.y();
      if (ring == 0) mesh.triangles.row(triangle++) << 0, vertex(0, k + 1), vertex(0, k);
      if (ring == rings - 1) mesh.triangles.row(triangle++) << 1, vertex(ring, k), vertex(ring, k + 1);
      if (ring == rings - 1) continue;
      mesh.triangles.row(triangle++) << vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1);
      mesh.triangles.row(triangle++) << vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k);
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh boxMesh(const Eigen::Vector3d& size) {
  TriangleMesh mesh{Points(8, 3), Triangles(12, 3)};
  for (int k = 0; k < 8; ++k)
    mesh.vertices.row(k) << (k & 1 ? 0.5 : -0.5) * size.x(), (k & 2 ? 0.5 : -0.5) * size.y(),
        (k & 4 ? 0.5 : -0.5) * size.z();
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2,
      1, 3, 7, 1, 7, 5;
  return mesh;
}

TriangleMesh cylinderMesh(double radius, double length) {
  const double end = 0.5 * length;
  return turned({{0.0, -end}, {radius, -end}, {radius, end}, {0.0, end}}, cornersOfCircle(radius));
}

TriangleMesh sphereMesh(double radius) {
  const int corners = cornersOfCircle(radius), bands = std::max(3, corners / 2);
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k <= bands; ++k) {
    const double angle = M_PI * k / bands;
    profile.emplace_back(radius * std::sin(angle), -radius * std::cos(angle));
  }
  return turned(profile, corners);
}

void append(const TriangleMesh& part, TriangleMesh* whole) {
  const auto vertices = whole->vertices.rows(), triangles = whole->triangles.rows();
  whole->vertices.conservativeResize(vertices + part.vertices.rows(), 3);
  whole->vertices.bottomRows(part.vertices.rows()) = part.vertices;
  whole->triangles.conservativeResize(triangles + part.triangles.rows(), 3);
  whole->triangles.bottomRows(part.triangles.rows()) = part.triangles.array() + static_cast<int>(vertices);
}

}  // namespace softbody
