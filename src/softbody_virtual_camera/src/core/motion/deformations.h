#pragma once

#include <Eigen/Core>

namespace softbody::virtual_camera {

/// Pure bending about the y axis. The plane z = 0 becomes a cylinder of this curvature [1/m] and keeps its
/// lengths along x. Cross-sections stay plane and normal to the cylinder. The origin and its tangent plane do
/// not move; a positive curvature moves the ends towards +z. |curvature| must be less than 1 / |z|; zero is
/// allowed.
Eigen::Vector3d bend(const Eigen::Vector3d& rest, double curvature);

/// Twisting about the x axis by `rate` [rad/m]. It preserves volume.
Eigen::Vector3d twist(const Eigen::Vector3d& rest, double rate);

/// A pull (strain > 0) or push (strain < 0) along x.
struct Stretch {
  double strain = 0.0;         ///< in the middle; falls smoothly to 0 at both ends; > -1
  double half_length_m = 0.1;  ///< the body is between -half_length_m (fixed) and +half_length_m
  double poisson_ratio =
      0.2;  ///< the cross-section scales by (1 + strain)^-poisson_ratio; 0.5 preserves volume
};
Eigen::Vector3d stretch(const Eigen::Vector3d& rest, const Stretch& stretch);

/// A press from above: a Gaussian dent in z, deepest at the contact, zero at the floor.
struct Dent {
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< touched point at rest [m]
  double floor_m = 0.0;                               ///< z of the fixed floor
  double width_m = 0.018;                             ///< standard deviation
  double depth_m = 0.0;                               ///< less than the height between floor and contact
};
Eigen::Vector3d dent(const Eigen::Vector3d& rest, const Dent& dent);

}  // namespace softbody::virtual_camera
