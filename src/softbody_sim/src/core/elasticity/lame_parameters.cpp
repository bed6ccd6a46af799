#include "elasticity/lame_parameters.h"

#include <fmt/format.h>

#include <stdexcept>

namespace softbody {

Lame lameParameters(double youngs_modulus_pa, double poisson_ratio) {
  if (!(youngs_modulus_pa > 0.0) || !(poisson_ratio >= 0.0 && poisson_ratio < 0.5)) {
    throw std::invalid_argument(fmt::format(
        "material: youngs_modulus_pa is {}, allowed: above 0; poisson_ratio is {}, allowed: [0, 0.5)",
        youngs_modulus_pa, poisson_ratio));
  }
  return {youngs_modulus_pa / (2.0 * (1.0 + poisson_ratio)),
          youngs_modulus_pa * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio))};
}

double youngsModulus(const Lame& lame) {
  return lame.mu * (3.0 * lame.lambda + 2.0 * lame.mu) / (lame.lambda + lame.mu);
}

}  // namespace softbody
