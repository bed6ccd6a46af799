#include "registration/surface_samples.h"

#include <Eigen/Dense>
#include <stdexcept>

#include "softbody_common/statistics/random.h"

namespace softbody::scanning {
namespace {

constexpr float kSeen = 0.5f;

/// Twice the area.
double sizeOf(const TriangleMesh& mesh, Eigen::Index triangle) {
  const auto t = mesh.triangles.row(triangle);
  const Eigen::Vector3d a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
  return (b - a).cross(c - a).norm();
}

bool isSeen(const RegisteredSurface& surface, Eigen::Index triangle) {
  if (surface.seen.empty()) return true;
  const auto t = surface.mesh.triangles.row(triangle);
  return surface.seen[t[0]] >= kSeen && surface.seen[t[1]] >= kSeen && surface.seen[t[2]] >= kSeen;
}

SurfaceSample sampleOf(const RegisteredSurface& surface, Eigen::Index triangle, std::uint64_t seed) {
  double s = unit(hash(seed, 1)), r = unit(hash(seed, 2));
  if (s + r > 1.0) s = 1.0 - s, r = 1.0 - r;
  const auto t = surface.mesh.triangles.row(triangle);
  const auto mean = [&](const Points& rows) -> Eigen::Vector3d {
    return (1.0 - s - r) * rows.row(t[0]) + s * rows.row(t[1]) + r * rows.row(t[2]);
  };
  return {mean(surface.mesh.vertices),
          surface.colors.rows() > 0 ? mean(surface.colors) : Eigen::Vector3d(Eigen::Vector3d::Zero())};
}

}  // namespace

std::vector<SurfaceSample> sampleSeen(const RegisteredSurface& surface, int count) {
  double total = 0.0;
  for (Eigen::Index t = 0; t < surface.mesh.triangles.rows(); ++t)
    if (isSeen(surface, t)) total += sizeOf(surface.mesh, t);
  if (!(total > 0.0)) throw std::invalid_argument("no part of the surface was seen");
  std::vector<SurfaceSample> samples;
  double passed = 0.0;
  for (Eigen::Index t = 0; t < surface.mesh.triangles.rows(); ++t) {
    if (!isSeen(surface, t)) continue;
    passed += sizeOf(surface.mesh, t);
    while (static_cast<double>(samples.size()) + 0.5 < passed / total * count)
      samples.push_back(sampleOf(surface, t, samples.size()));
  }
  return samples;
}

}  // namespace softbody::scanning
