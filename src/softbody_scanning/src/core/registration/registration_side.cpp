#include "registration/registration_side.h"

#include <Eigen/Dense>

namespace softbody::scanning {

namespace {

/// Centre of the volume that a closed mesh encloses.
Eigen::Vector3d centreOfVolume(const TriangleMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double volume = 0.0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
                          c = mesh.vertices.row(t[2]);
    const double part = a.dot(b.cross(c));
    volume += part;
    sum += 0.25 * part * (a + b + c);
  }
  return sum / volume;
}

std::vector<Eigen::Vector3d> smoothedSeen(const RegisteredSurface& surface) {
  Points sums = surface.mesh.vertices;
  Eigen::VectorXd counts = Eigen::VectorXd::Ones(sums.rows());
  for (const auto& t : surface.mesh.triangles.rowwise())
    for (int corner = 0; corner < 3; ++corner) {  // of a closed mesh: each edge once in each direction
      sums.row(t[corner]) += surface.mesh.vertices.row(t[(corner + 1) % 3]);
      counts[t[corner]] += 1.0;
    }
  std::vector<Eigen::Vector3d> places;
  for (Eigen::Index v = 0; v < sums.rows(); ++v)
    if (surface.seen.empty() || surface.seen[v] >= 0.5f) places.push_back(sums.row(v) / counts[v]);
  return places;
}

}  // namespace

RegistrationSide::RegistrationSide(const RegisteredSurface& surface, int samples)
    : surface_(surface),
      query_(surface.mesh.vertices, surface.mesh.triangles),
      samples_(sampleSeen(surface, samples)),
      seen_places_(smoothedSeen(surface)),
      middle_(centreOfVolume(surface.mesh)) {}

RegistrationSide::Closest RegistrationSide::closest(const Eigen::Vector3d& point) const {
  const SurfacePoint place = query_.closest(point);
  const auto t = surface_.mesh.triangles.row(place.triangle);
  const Eigen::Vector3d a = surface_.mesh.vertices.row(t[0]), b = surface_.mesh.vertices.row(t[1]),
                        c = surface_.mesh.vertices.row(t[2]);
  Closest found{place.position, (b - a).cross(c - a).normalized(), Eigen::Vector3d::Zero(), true};
  if (surface_.colors.rows() > 0)
    found.color = (surface_.colors.row(t[0]) + surface_.colors.row(t[1]) + surface_.colors.row(t[2])) / 3.0;
  if (!surface_.seen.empty())
    found.seen = std::min({surface_.seen[t[0]], surface_.seen[t[1]], surface_.seen[t[2]]}) >= 0.5f;
  return found;
}

double RegistrationSide::diagonal() const {
  const Points& vertices = surface_.mesh.vertices;
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

}  // namespace softbody::scanning
