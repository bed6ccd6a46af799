#include "shells/shell_list.h"

#include <cmath>
#include <utility>

#include "shells/connected_groups.h"
#include "surface_mesh/manifold_mesh.h"

namespace softbody {
namespace {

constexpr double kThinnest = 1e-3;   ///< mean thickness of a body over its size; a sheet of paper has 3e-4
constexpr double kSameSpace = 1e-6;  ///< relative difference of equal shells, above the welding distance

Eigen::Matrix3d cornersOf(const TriangleMesh& mesh, Eigen::Index f) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.row(k) = mesh.vertices.row(mesh.triangles(f, k));
  return corners;
}

void measure(const TriangleMesh& mesh, Shell* shell) {
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  for (const Eigen::Index f : shell->triangles) middle += cornersOf(mesh, f).colwise().mean();
  middle /= static_cast<double>(shell->triangles.size());
  for (const Eigen::Index f : shell->triangles) {
    const Eigen::Matrix3d corners = cornersOf(mesh, f).rowwise() - middle;
    const Eigen::Vector3d a = corners.row(0), b = corners.row(1), c = corners.row(2);
    shell->volume += a.dot(b.cross(c)) / 6.0;
    shell->area += 0.5 * (b - a).cross(c - a).norm();
    for (int k = 0; k < 3; ++k) shell->box.extend(Eigen::Vector3d(corners.row(k) + middle));
  }
}

/// How often a shell winds around a point: 1 inside, 0 outside (van Oosterom and Strackee 1983).
double windingNumber(const TriangleMesh& mesh, const Shell& shell, const Eigen::RowVector3d& point) {
  double angle = 0.0;
  for (const Eigen::Index f : shell.triangles) {
    const Eigen::Matrix3d corners = cornersOf(mesh, f).rowwise() - point;
    const Eigen::Vector3d a = corners.row(0), b = corners.row(1), c = corners.row(2);
    angle += std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                               b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return std::abs(angle) / (2.0 * M_PI);
}

}  // namespace

bool Shell::isSheet() const { return 2.0 * std::abs(volume) <= kThinnest * box.diagonal().norm() * area; }

std::vector<Shell> shellsOf(const TriangleMesh& mesh) {
  const TriangleList triangles = listOf(mesh.triangles);
  const std::vector<int> mates = matesAcrossBody(triangles, mesh.vertices);
  std::vector<std::pair<std::size_t, std::size_t>> neighbours;
  for (std::size_t h = 0; h < mates.size(); ++h)
    if (mates[h] >= 0) neighbours.emplace_back(h / 3, static_cast<std::size_t>(mates[h]) / 3);
  std::vector<Shell> shells;
  for (const std::vector<std::size_t>& group : connectedGroups(triangles.size(), neighbours))
    shells.emplace_back().triangles.assign(group.begin(), group.end());
  for (Shell& shell : shells) measure(mesh, &shell);
  return shells;
}

std::vector<std::vector<std::size_t>> containersOf(const TriangleMesh& mesh,
                                                   const std::vector<Shell>& shells) {
  std::vector<std::vector<std::size_t>> containers(shells.size());
  for (std::size_t inner = 0; inner < shells.size(); ++inner) {
    for (std::size_t outer = 0; outer < shells.size(); ++outer) {
      if (inner == outer || !shells[outer].box.contains(shells[inner].box)) continue;
      const Eigen::RowVector3d point = cornersOf(mesh, shells[inner].triangles.front()).colwise().mean();
      if (windingNumber(mesh, shells[outer], point) > 0.5) containers[inner].push_back(outer);
    }
  }
  return containers;
}

std::vector<bool> repeatedShells(const std::vector<Shell>& shells) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= kSameSpace * std::abs(a); };
  const auto same = [&near](const Shell& a, const Shell& b) {
    const double tolerance = kSameSpace * a.box.diagonal().norm();
    return (a.box.min() - b.box.min()).norm() <= tolerance &&
           (a.box.max() - b.box.max()).norm() <= tolerance && near(a.area, b.area) &&
           near(std::abs(a.volume), std::abs(b.volume));
  };
  std::vector<bool> repeated(shells.size(), false);
  for (std::size_t i = 0; i < shells.size(); ++i)
    for (std::size_t k = 0; k < i && !repeated[i]; ++k) repeated[i] = same(shells[k], shells[i]);
  return repeated;
}

}  // namespace softbody
