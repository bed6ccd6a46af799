#pragma once

#include <Eigen/Core>

namespace softbody::virtual_camera {

/// Pure bending about the y axis: the plane z = 0 becomes a cylinder of this curvature [1/m] and keeps its
/// lengths along x; the cross-sections stay plane and normal to it. The origin and its tangent plane stay
/// where they are; with a positive curvature the ends move towards +z. Any |curvature| < 1 / |z|, zero
/// included.
Eigen::Vector3d bend(const Eigen::Vector3d& rest, double curvature);

/// Twisting about the x axis by `rate` [rad/m]; keeps the volume of every part.
Eigen::Vector3d twist(const Eigen::Vector3d& rest, double rate);

/// A pull (strain > 0) or push (strain < 0) along x.
struct Stretch {
  double strain = 0.0;         ///< in the middle, falling smoothly to 0 at both ends; > -1
  double half_length_m = 0.1;  ///< the body reaches from -half_length_m, which stays, to +half_length_m
  double poisson_ratio = 0.2;  ///< the cross-section scales by (1 + strain)^-poisson_ratio: 0.5 keeps volume
};
Eigen::Vector3d stretch(const Eigen::Vector3d& rest, const Stretch& stretch);

/// A press from above: a Gaussian dent in z, deepest at the contact, fading to nothing at the floor.
struct Dent {
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< where the body is touched at rest [m]
  double floor_m = 0.0;                               ///< z that stays
  double width_m = 0.018;                             ///< standard deviation
  double depth_m = 0.0;                               ///< less than the height between floor and contact
};
Eigen::Vector3d dent(const Eigen::Vector3d& rest, const Dent& dent);

}  // namespace softbody::virtual_camera
