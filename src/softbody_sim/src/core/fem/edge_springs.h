#pragma once

#include <Eigen/Core>

namespace softbody {

/// Springs along the six edges of a tet, as an energy density of its deformation gradient F. A spring's
/// stiffness is E V / length^2 (Van Gelder 1998). If edges have all directions alike, small strains obey
/// Hooke's law with E and a Poisson's ratio of 1/4.
class EdgeSprings {
 public:
  using Edges = Eigen::Matrix<double, 3, 6>;
  using Hessian = Eigen::Matrix<double, 9, 9>;

  EdgeSprings() = default;
  /// @param edges at rest, as columns [m].
  EdgeSprings(const Edges& edges, double youngs_modulus_pa) : edges_(edges), stiffness_(youngs_modulus_pa) {}

  /// [J/m^3]
  double energy(const Eigen::Matrix3d& F) const;
  /// d energy / d F [Pa]
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const;
  /// By vec(F) [Pa]. @param project leaves out the part of shortened springs that is negative.
  Hessian hessian(const Eigen::Matrix3d& F, bool project) const;

 private:
  Edges edges_ = Edges::Zero();
  double stiffness_ = 0.0;  ///< E [Pa]
};

}  // namespace softbody
