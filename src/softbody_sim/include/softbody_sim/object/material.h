#pragma once

namespace softbody {

/// A homogeneous isotropic elastic material.
struct Material {
  double youngs_modulus_pa = 2.0e4;
  double poisson_ratio = 0.2;  ///< below 0.5
  double density_kg_m3 = 30.0;
  double damping = 0.1;  ///< fraction of the velocity lost per 1/30 s, 0..1
};

/// The values that a material may have, both ends included.
struct MaterialRange {
  double min, max;
};
constexpr MaterialRange kYoungsModulusRange{1.0, 1e12};  // [Pa]
constexpr MaterialRange kPoissonRatioRange{0.0, 0.495};
constexpr MaterialRange kDensityRange{0.1, 30000.0};  // [kg/m^3]
constexpr MaterialRange kDampingRange{0.0, 1.0};

/// @throw std::invalid_argument with key, value and range if a value is out of its range.
void requireUsable(const Material& material);

}  // namespace softbody
