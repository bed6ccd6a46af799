#pragma once

namespace softbody {

/// A homogeneous isotropic elastic material.
struct Material {
  double youngs_modulus_pa = 2.0e4;
  double poisson_ratio = 0.2;  ///< below 0.5
  double density_kg_m3 = 30.0;
  double damping = 0.1;  ///< fraction of the velocity lost per 1/30 s, 0..1
};

}  // namespace softbody
