#include "motion/deformations.h"

#include <Eigen/Geometry>
#include <cmath>

namespace softbody::virtual_camera {

Eigen::Vector3d bend(const Eigen::Vector3d& rest, double curvature) {
  const double angle = curvature * rest.x();
  const double sine = std::sin(0.5 * angle), cosine = std::cos(0.5 * angle);
  const double half = std::abs(angle) < 1e-6 ? 1.0 : 2.0 * sine / angle;  // sinc of half the angle
  const double along = rest.x() * half * cosine, sag = rest.x() * half * sine;
  return {along - 2.0 * rest.z() * sine * cosine, rest.y(), sag + rest.z() * (1.0 - 2.0 * sine * sine)};
}

Eigen::Vector3d twist(const Eigen::Vector3d& rest, double rate) {
  return Eigen::AngleAxisd(rate * rest.x(), Eigen::Vector3d::UnitX()) * rest;
}

Eigen::Vector3d stretch(const Eigen::Vector3d& rest, const Stretch& stretch) {
  const double wave = M_PI / stretch.half_length_m, half_strain = 0.5 * stretch.strain;
  const double local = 1.0 + half_strain * (1.0 + std::cos(wave * rest.x()));
  const double along =
      rest.x() + half_strain * (rest.x() + stretch.half_length_m + std::sin(wave * rest.x()) / wave);
  const double across = std::pow(local, -stretch.poisson_ratio);
  return {along, across * rest.y(), across * rest.z()};
}

Eigen::Vector3d dent(const Eigen::Vector3d& rest, const Dent& dent) {
  const Eigen::Vector2d offset = (rest - dent.contact).head<2>() / dent.width_m;
  const double height = (rest.z() - dent.floor_m) / (dent.contact.z() - dent.floor_m);
  const double sink = dent.depth_m * std::exp(-0.5 * offset.squaredNorm()) * height;
  return rest - Eigen::Vector3d(0.0, 0.0, sink);
}

}  // namespace softbody::virtual_camera
