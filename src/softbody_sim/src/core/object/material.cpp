#include "softbody_sim/object/material.h"

#include <fmt/format.h>

#include <stdexcept>

namespace softbody {
namespace {

void requireWithin(const char* key, double value, const MaterialRange& range) {
  if (value >= range.min && value <= range.max) return;  // false for NaN
  throw std::invalid_argument(
      fmt::format("{} is {:g}; allowed: {:g} to {:g}", key, value, range.min, range.max));
}

}  // namespace

void requireUsable(const Material& material) {
  requireWithin("youngs_modulus_pa", material.youngs_modulus_pa, kYoungsModulusRange);
  requireWithin("poisson_ratio", material.poisson_ratio, kPoissonRatioRange);
  requireWithin("density_kg_m3", material.density_kg_m3, kDensityRange);
  requireWithin("damping", material.damping, kDampingRange);
  if (material.youngs_modulus_std_pa)
    requireWithin("youngs_modulus_std_pa", *material.youngs_modulus_std_pa, kYoungsModulusStdRange);
  for (const MaterialRegion& region : material.regions) {
    requireWithin("youngs_modulus_pa of a region", region.youngs_modulus_pa, kYoungsModulusRange);
    requireWithin("poisson_ratio of a region", region.poisson_ratio, kPoissonRatioRange);
    requireWithin("density_kg_m3 of a region", region.density_kg_m3, kDensityRange);
  }
}

}  // namespace softbody
