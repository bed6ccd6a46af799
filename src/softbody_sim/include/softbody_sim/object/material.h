#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace softbody {

/// A part of the body with an elastic material of its own: the tets whose centre at rest lies in a box.
struct MaterialRegion {
  Eigen::Vector3d min, max;  ///< in rest space [m]; may be infinite
  double youngs_modulus_pa;
  double poisson_ratio;
  double density_kg_m3;
};

/// An isotropic elastic material.
struct Material {
  double youngs_modulus_pa = 2.0e4;
  double poisson_ratio = 0.2;  ///< below 0.5
  double density_kg_m3 = 30.0;
  double damping = 0.1;                      ///< fraction of the velocity lost per 1/30 s, 0..1
  std::vector<MaterialRegion> regions = {};  ///< of other materials; the last that contains a tet counts
  /// Standard deviation of Young's modulus, if it was measured: then forces are known in newtons.
  std::optional<double> youngs_modulus_std_pa = {};
};

/// The values that a material may have, both ends included.
struct MaterialRange {
  double min, max;
};
constexpr MaterialRange kYoungsModulusRange{1.0, 1e12};  // [Pa]
constexpr MaterialRange kPoissonRatioRange{0.0, 0.495};  // 0.5 is incompressible
constexpr MaterialRange kDensityRange{0.1, 30000.0};     // [kg/m^3]
constexpr MaterialRange kDampingRange{0.0, 1.0};

constexpr MaterialRange kYoungsModulusStdRange{1e-3, 1e12};  // [Pa]

/// @throw std::invalid_argument with key, value and range if a value is out of its range, also of a region.
void requireUsable(const Material& material);

}  // namespace softbody
