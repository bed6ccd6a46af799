#pragma once

namespace softbody {

/// Lamé parameters [Pa].
struct Lame {
  double mu = 0.0;
  double lambda = 0.0;
};

/// @throw std::invalid_argument unless E > 0 and 0 <= nu < 0.5.
Lame lameParameters(double youngs_modulus_pa, double poisson_ratio);
/// E [Pa].
double youngsModulus(const Lame& lame);

}  // namespace softbody
