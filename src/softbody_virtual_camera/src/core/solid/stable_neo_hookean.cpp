#include "solid/stable_neo_hookean.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "softbody_common/geometry/rigid_motion.h"

namespace softbody::virtual_camera {
namespace {

/// The derivative of the determinant.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d result;
  result << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
  return result;
}

}  // namespace

StableNeoHookean::StableNeoHookean(double youngs_modulus_pa, double poisson_ratio) {
  const double mu = youngs_modulus_pa / (2.0 * (1.0 + poisson_ratio));
  const double lambda = 2.0 * mu * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
  // Section 3.4 of the source: so that small strains have these Lame constants.
  mu_ = 4.0 / 3.0 * mu;
  lambda_ = lambda + 5.0 / 6.0 * mu;
  alpha_ = 1.0 + 0.75 * mu_ / lambda_;
  rest_energy_ = 0.0;
  rest_energy_ = energy(Eigen::Matrix3d::Identity());
}

double StableNeoHookean::energy(const Eigen::Matrix3d& F) const {
  const double squares = F.squaredNorm(), beyond = F.determinant() - alpha_;
  return 0.5 * mu_ * (squares - 3.0 - std::log(squares + 1.0)) + 0.5 * lambda_ * beyond * beyond -
         rest_energy_;
}

Eigen::Matrix3d StableNeoHookean::stress(const Eigen::Matrix3d& F) const {
  return mu_ * (1.0 - 1.0 / (F.squaredNorm() + 1.0)) * F +
         lambda_ * (F.determinant() - alpha_) * cofactors(F);
}

StableNeoHookean::Matrix9 StableNeoHookean::stiffnessOf(const Eigen::Matrix3d& F, bool positive) const {
  const Eigen::Matrix3d cofactor = cofactors(F);
  const Eigen::Map<const Eigen::Matrix<double, 9, 1>> f(F.data()), g(cofactor.data());
  const double squares = F.squaredNorm() + 1.0, pressure = lambda_ * (F.determinant() - alpha_);
  Matrix9 result = mu_ * (1.0 - 1.0 / squares) * Matrix9::Identity();
  result += 2.0 * mu_ / (squares * squares) * f * f.transpose() + lambda_ * g * g.transpose();
  for (const auto& [row, column, other, sign] :
       {std::array{0, 1, 2, -1}, std::array{0, 2, 1, 1}, std::array{1, 2, 0, -1}}) {
    const Eigen::Matrix3d block = sign * pressure * crossMatrix(F.col(other));
    result.block<3, 3>(3 * row, 3 * column) += block;
    result.block<3, 3>(3 * column, 3 * row) += block.transpose();
  }
  if (!positive) return result;
  const Eigen::SelfAdjointEigenSolver<Matrix9> solver(result);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() *
         solver.eigenvectors().transpose();
}

}  // namespace softbody::virtual_camera
