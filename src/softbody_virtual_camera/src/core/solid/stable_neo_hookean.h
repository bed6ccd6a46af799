#pragma once

#include <Eigen/Core>

/// A finite element solver for the truth of scenes. It shares nothing with softbody_sim, which it judges.
namespace softbody::virtual_camera {

/// The stable neo-Hookean energy with its logarithmic term (Smith, de Goes and Kim 2018, Stable Neo-Hookean
/// Flesh Simulation). F is the deformation gradient; vectors of nine numbers have its columns one after the
/// other.
class StableNeoHookean {
 public:
  using Matrix9 = Eigen::Matrix<double, 9, 9>;

  /// @param youngs_modulus_pa, poisson_ratio of small strains.
  StableNeoHookean(double youngs_modulus_pa, double poisson_ratio);

  double energy(const Eigen::Matrix3d& F) const;           ///< [J/m^3]; 0 at rest
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const;  ///< first Piola-Kirchhoff [Pa]
  /// Derivative of the stress [Pa]. @param positive without negative eigenvalues.
  Matrix9 stiffnessOf(const Eigen::Matrix3d& F, bool positive) const;

 private:
  double mu_, lambda_, alpha_, rest_energy_;
};

}  // namespace softbody::virtual_camera
