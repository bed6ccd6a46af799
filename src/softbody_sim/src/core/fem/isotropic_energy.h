#pragma once

#include <Eigen/Core>

#include "elasticity/lame_parameters.h"
#include "softbody_sim/elasticity/elasticity.h"

namespace softbody {

/// An isotropic energy density as a function of the principal stretches s, with the closed-form eigenvalues
/// of its Hessian with respect to F (Smith, de Goes, Kim 2019, "Analytic eigensystems for isotropic
/// distortion energies"). The stretches are the signed singular values of the deformation gradient F = U
/// diag(s) V^T with rotations U and V.
struct IsotropicEnergy {
  double energy = 0.0;       ///< [J/m^3]
  Eigen::Vector3d gradient;  ///< d energy / d s_i [Pa]
  Eigen::Matrix3d hessian;   ///< d^2 energy / d s_i d s_j [Pa]: Hessian of the three scaling modes
  Eigen::Vector3d twist;     ///< (g_j + g_k) / (s_j + s_k) [Pa], eigenvalue of the rotation about axis i
  Eigen::Vector3d flip;      ///< (g_j - g_k) / (s_j - s_k) [Pa], eigenvalue of the shear about axis i
};

/// mu |F - R|^2 + lambda/2 tr^2(R^T F - I), the energy of projective dynamics. R is never a reflection.
IsotropicEnergy corotatedIsotropicEnergy(const Eigen::Vector3d& stretches, const Lame& lame);

/// Stable neo-Hookean energy (Smith, de Goes, Kim 2018, eq. 14) minus its value at rest. The parameters
/// follow section 3.4: small strains obey Hooke's law with `lame`. Smooth and finite for every F.
IsotropicEnergy neoHookeanIsotropicEnergy(const Eigen::Vector3d& stretches, const Lame& lame);

/// The energy of a material model: corotated or neo-Hookean.
IsotropicEnergy isotropicEnergy(Elasticity elasticity, const Eigen::Vector3d& stretches, const Lame& lame);

}  // namespace softbody
