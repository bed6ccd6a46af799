#include "registration/registration_side.h"

#include <Eigen/Dense>

namespace softbody::scanning {

RegistrationSide::RegistrationSide(const RegisteredSurface& surface, int samples)
    : surface_(surface),
      query_(surface.mesh.vertices, surface.mesh.triangles),
      samples_(sampleSeen(surface, samples)),
      middle_(0.5 * (surface.mesh.vertices.colwise().minCoeff() + surface.mesh.vertices.colwise().maxCoeff())
                        .transpose()) {}

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

Eigen::Matrix3d RegistrationSide::axes() const {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const SurfaceSample& sample : samples_)
    covariance += (sample.position - middle_) * (sample.position - middle_).transpose();
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  return axes;
}

double RegistrationSide::diagonal() const {
  const Points& vertices = surface_.mesh.vertices;
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

}  // namespace softbody::scanning
