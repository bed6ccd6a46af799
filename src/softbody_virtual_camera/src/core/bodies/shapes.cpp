#include "softbody_virtual_camera/bodies/shapes.h"

#include <Eigen/Dense>
#include <cmath>

namespace softbody::virtual_camera {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSectors = 24, kRingsPerEnd = 6;

/// Triangles of a pole, `rings` rings of kSectors vertices each, and the other pole.
Triangles ringTriangles(int rings) {
  Triangles triangles(2 * kSectors * rings, 3);
  const int last = 1 + rings * kSectors;
  Eigen::Index row = 0;
  for (int j = 0; j < kSectors; ++j) {
    const int next = (j + 1) % kSectors;
    triangles.row(row++) << 0, 1 + next, 1 + j;
    for (int i = 0; i + 1 < rings; ++i) {
      const int ring = 1 + i * kSectors, below = ring + kSectors;
      triangles.row(row++) << ring + j, ring + next, below + next;
      triangles.row(row++) << ring + j, below + next, below + j;
    }
    triangles.row(row++) << last, last - kSectors + j, last - kSectors + next;
  }
  return triangles;
}

}  // namespace

TriangleMesh rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                       const Eigen::Vector3d& edge_v) {
  TriangleMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.vertices << corner.transpose(), (corner + edge_u).transpose(), (corner + edge_u + edge_v).transpose(),
      (corner + edge_v).transpose();
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

TriangleMesh box(const Eigen::Vector3d& size) {
  const Eigen::Vector3d low = -0.5 * size, high = 0.5 * size;
  const Eigen::Vector3d x = size.x() * Eigen::Vector3d::UnitX(), y = size.y() * Eigen::Vector3d::UnitY(),
                        z = size.z() * Eigen::Vector3d::UnitZ();
  return merge({rectangle(low, y, x), rectangle(low, z, y), rectangle(low, x, z), rectangle(high, -x, -y),
                rectangle(high, -y, -z), rectangle(high, -z, -x)});
}

TriangleMesh capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_m) {
  return capsule(a, b, radius_m, radius_m);
}

TriangleMesh capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a_m,
                     double radius_b_m) {
  const Eigen::Vector3d axis = (b - a).normalized(), x = axis.unitOrthogonal(), y = axis.cross(x);
  constexpr int kRings = 2 * kRingsPerEnd;
  TriangleMesh mesh{Points(2 + kRings * kSectors, 3), ringTriangles(kRings)};
  mesh.vertices.topRows(1) = (a - radius_a_m * axis).transpose();
  mesh.vertices.bottomRows(1) = (b + radius_b_m * axis).transpose();
  for (int i = 0; i < kRings; ++i) {
    const bool first_end = i < kRingsPerEnd;
    const double latitude = 0.5 * kPi * (i + (first_end ? 1 : 0) - kRingsPerEnd) / kRingsPerEnd;
    const double radius = first_end ? radius_a_m : radius_b_m;
    const Eigen::Vector3d center = (first_end ? a : b) + radius * std::sin(latitude) * axis;
    for (int j = 0; j < kSectors; ++j) {
      const double longitude = 2.0 * kPi * j / kSectors;
      mesh.vertices.row(1 + i * kSectors + j) =
          center + radius * std::cos(latitude) * (std::cos(longitude) * x + std::sin(longitude) * y);
    }
  }
  return mesh;
}

TriangleMesh cylinder(double radius_m, double length_m) {
  constexpr int kCorners = 48;
  TriangleMesh mesh{Points(2 * kCorners + 2, 3), Triangles(4 * kCorners, 3)};
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * kPi * k / kCorners;
    const int next = (k + 1) % kCorners;
    mesh.vertices.row(k) << radius_m * std::cos(angle), radius_m * std::sin(angle), -0.5 * length_m;
    mesh.vertices.row(kCorners + k) = mesh.vertices.row(k) + length_m * Eigen::RowVector3d::UnitZ();
    mesh.triangles.row(4 * k) << k, next, kCorners + next;
    mesh.triangles.row(4 * k + 1) << k, kCorners + next, kCorners + k;
    mesh.triangles.row(4 * k + 2) << 2 * kCorners, next, k;
    mesh.triangles.row(4 * k + 3) << 2 * kCorners + 1, kCorners + k, kCorners + next;
  }
  mesh.vertices.bottomRows(2) << 0.0, 0.0, -0.5 * length_m, 0.0, 0.0, 0.5 * length_m;
  return mesh;
}

TriangleMesh ball(double radius_m) {
  constexpr double kApart = 1e-6;  // [m]; a capsule has an axis
  return capsule({0.0, 0.0, -kApart}, {0.0, 0.0, kApart}, radius_m);
}

TriangleMesh merge(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all{Points(0, 3), Triangles(0, 3)};
  for (const TriangleMesh& mesh : meshes) {
    const Eigen::Index vertices = all.vertices.rows(), triangles = all.triangles.rows();
    all.vertices.conservativeResize(vertices + mesh.vertices.rows(), 3);
    all.triangles.conservativeResize(triangles + mesh.triangles.rows(), 3);
    all.vertices.bottomRows(mesh.vertices.rows()) = mesh.vertices;
    all.triangles.bottomRows(mesh.triangles.rows()) = mesh.triangles.array() + static_cast<int>(vertices);
  }
  return all;
}

TriangleMesh hand() {
  std::vector<TriangleMesh> parts;
  const double tips[4] = {-0.012, 0.0, -0.006, -0.022};
  for (int i = 0; i < 4; ++i) {
    const double y = 0.022 * (i - 1.5);
    parts.push_back(capsule({-0.10, 0.9 * y, 0.0}, {tips[i] - 0.009, 1.05 * y, 0.0}, 0.010));
    parts.push_back(capsule({-0.18, 0.8 * y, 0.0}, {-0.09, 0.95 * y, 0.0}, 0.014));
  }
  parts.push_back(capsule({-0.16, 0.03, 0.0}, {-0.075, 0.065, 0.0}, 0.012));
  parts.push_back(capsule({-0.45, 0.0, 0.0}, {-0.17, 0.0, 0.0}, 0.032));
  return merge(parts);
}

Points transformed(const Eigen::Isometry3d& T, const Points& points) {
  return (points * T.linear().transpose()).rowwise() + T.translation().transpose();
}

}  // namespace softbody::virtual_camera
