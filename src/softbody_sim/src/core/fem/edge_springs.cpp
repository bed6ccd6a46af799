#include "fem/edge_springs.h"

#include <algorithm>

namespace softbody {

double EdgeSprings::energy(const Eigen::Matrix3d& F) const {
  const Eigen::Array<double, 1, 6> stretches =
      (F * edges_).colwise().norm().array() / edges_.colwise().norm().array();
  return 0.5 * stiffness_ * (stretches - 1.0).square().sum();
}

Eigen::Matrix3d EdgeSprings::stress(const Eigen::Matrix3d& F) const {
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  for (const auto& edge : edges_.colwise()) {
    const double length = edge.norm();
    const Eigen::Vector3d now = F * edge;
    stress += stiffness_ * (now.norm() / length - 1.0) / length * now.normalized() * edge.transpose();
  }
  return stress;
}

EdgeSprings::Hessian EdgeSprings::hessian(const Eigen::Matrix3d& F, bool project) const {
  // Of a shorter spring the direction is not defined.
  constexpr double kLeastStretch = 1e-6;
  Hessian hessian = Hessian::Zero();
  for (const auto& edge : edges_.colwise()) {
    const double length = edge.norm();
    const Eigen::Vector3d now = F * edge, along = now.normalized();
    const double stretch = std::max(now.norm() / length, kLeastStretch);
    const double across = project ? std::max(1.0 - 1.0 / stretch, 0.0) : 1.0 - 1.0 / stretch;
    const Eigen::Matrix3d of_end =
        across * Eigen::Matrix3d::Identity() + (1.0 - across) * along * along.transpose();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        hessian.block<3, 3>(3 * i, 3 * j) += stiffness_ * edge[i] * edge[j] / (length * length) * of_end;
    }
  }
  return hessian;
}

}  // namespace softbody
