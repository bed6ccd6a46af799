#include "fem/isotropic_energy.h"

#include <cmath>

namespace softbody {
namespace {

Eigen::Vector3d sumsOfOthers(const Eigen::Vector3d& s) { return {s[1] + s[2], s[2] + s[0], s[0] + s[1]}; }

Eigen::Vector3d productsOfOthers(const Eigen::Vector3d& s) { return {s[1] * s[2], s[2] * s[0], s[0] * s[1]}; }

}  // namespace

IsotropicEnergy corotatedIsotropicEnergy(const Eigen::Vector3d& stretches, const Lame& lame) {
  const Eigen::Vector3d strain = stretches - Eigen::Vector3d::Ones();
  const double dilation = strain.sum();
  IsotropicEnergy density;
  density.energy = lame.mu * strain.squaredNorm() + 0.5 * lame.lambda * dilation * dilation;
  density.gradient = 2.0 * lame.mu * strain + Eigen::Vector3d::Constant(lame.lambda * dilation);
  density.hessian = Eigen::Matrix3d::Constant(lame.lambda);
  density.hessian.diagonal().array() += 2.0 * lame.mu;
  // If two stretches sum to zero, the rotation is not unique and the energy has a kink.
  constexpr double kSmallestSum = 1e-6;
  const Eigen::Vector3d sums = sumsOfOthers(stretches).cwiseMax(kSmallestSum);
  density.twist.array() = 2.0 * lame.mu + (2.0 * lame.lambda * dilation - 4.0 * lame.mu) / sums.array();
  density.flip.setConstant(2.0 * lame.mu);
  return density;
}

IsotropicEnergy neoHookeanIsotropicEnergy(const Eigen::Vector3d& stretches, const Lame& lame) {
  const double mu = 4.0 / 3.0 * lame.mu;
  const double lambda = lame.lambda + 5.0 / 6.0 * lame.mu;
  const double alpha = 1.0 + 0.75 * mu / lambda;
  const double squares = stretches.squaredNorm();
  const double excess = stretches.prod() - alpha;
  const Eigen::Vector3d cofactors = productsOfOthers(stretches);
  const double shear = mu * (1.0 - 1.0 / (squares + 1.0));
  const double rest = 0.5 * lambda * (1.0 - alpha) * (1.0 - alpha) - 0.5 * mu * std::log(4.0);

  IsotropicEnergy density;
  density.energy =
      0.5 * mu * (squares - 3.0) + 0.5 * lambda * excess * excess - 0.5 * mu * std::log(squares + 1.0) - rest;
  density.gradient = shear * stretches + lambda * excess * cofactors;
  density.hessian = 2.0 * mu / ((squares + 1.0) * (squares + 1.0)) * stretches * stretches.transpose() +
                    lambda * cofactors * cofactors.transpose();
  for (int i = 0; i < 3; ++i) {
    density.hessian(i, i) += shear;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    density.hessian(j, k) += lambda * excess * stretches[i];
    density.hessian(k, j) += lambda * excess * stretches[i];
  }
  density.twist = Eigen::Vector3d::Constant(shear) + lambda * excess * stretches;
  density.flip = Eigen::Vector3d::Constant(shear) - lambda * excess * stretches;
  return density;
}

IsotropicEnergy isotropicEnergy(Elasticity elasticity, const Eigen::Vector3d& stretches, const Lame& lame) {
  return elasticity == Elasticity::kCorotated ? corotatedIsotropicEnergy(stretches, lame)
                                              : neoHookeanIsotropicEnergy(stretches, lame);
}

}  // namespace softbody
