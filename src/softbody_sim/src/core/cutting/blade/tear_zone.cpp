#include "cutting/blade/tear_zone.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

std::vector<bool> tetsAround(const TetTopology& volume, const std::vector<bool>& zone) {
  std::vector<bool> vertices(static_cast<std::size_t>(volume.rest_vertices.rows()), false), tets(zone.size());
  for (std::size_t t = 0; t < zone.size(); ++t)
    for (int k = 0; zone[t] && k < 4; ++k) vertices[volume.tets(static_cast<Eigen::Index>(t), k)] = true;
  for (std::size_t t = 0; t < zone.size(); ++t)
    for (int k = 0; k < 4; ++k)
      if (vertices[volume.tets(static_cast<Eigen::Index>(t), k)]) tets[t] = true;
  return tets;
}

TearZone tearZone(const TetTopology& volume, const std::vector<TetStretch>& stretches, int first,
                  double strain) {
  const auto count = static_cast<std::size_t>(volume.tets.rows());
  TearZone zone;
  zone.tets.assign(count, false);
  zone.tets[static_cast<std::size_t>(first)] = true;
  for (bool grows = true; grows;) {
    grows = false;
    const std::vector<bool> beside = tetsAround(volume, zone.tets);
    for (std::size_t t = 0; t < count; ++t) {
      if (zone.tets[t] || !beside[t] || stretches[t].least() <= 1.0 + strain) continue;
      zone.tets[t] = grows = true;
    }
  }
  const Eigen::VectorXd volumes = tetVolumes(volume.rest_vertices, volume.tets);
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double weights = 0.0, turns = 0.0;
  for (std::size_t t = 0; t < count; ++t) {
    if (!zone.tets[t]) continue;
    const TetStretch& now = stretches[t];
    const double weight = volumes[static_cast<Eigen::Index>(t)] * (now.stretch - 1.0) * (now.stretch - 1.0);
    const MaterialPoint center{static_cast<int>(t), Eigen::Vector4d::Constant(0.25)};
    middle += weight * positionOf(center, volume.rest_vertices, volume.tets);
    directions += weight * now.direction * now.direction.transpose();
    turns += weight * std::pow(now.deviation / (now.stretch - 1.0), 2);
    weights += weight;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(directions / weights);
  zone.place_m = 0.5 * meanEdgeLength(volume.rest_vertices, volume.tets);
  // A little beside the middle, so that the plane meets no vertices of a regular mesh.
  const Eigen::Vector3d normal = solver.eigenvectors().col(2);
  zone.plane = {middle / weights + 1e-3 * zone.place_m * normal, normal};
  // Standard error of the mean direction: by the angles to it, and by the noise of a direction; never 0.
  const double spread = 1.0 - solver.eigenvalues()[2] + turns / weights;
  const auto tets = static_cast<double>(std::count(zone.tets.begin(), zone.tets.end(), true));
  zone.tilt_rad = std::sqrt(std::max(1e-6, spread / tets));
  return zone;
}

}  // namespace softbody
