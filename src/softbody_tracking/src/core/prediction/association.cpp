#include "prediction/association.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr std::size_t kEnoughForMedian = 500;  // of more every second, third, ...
constexpr double kSmallestScale = 0.003;  // [m], of the Cauchy weights: below the noise nothing is an outlier

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Normal equations of a small motion about a centre.
struct MotionEquations {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  double size = 0.0;

  void add(const Association& a, double weight) {
    const Eigen::Vector3d arm = a.predicted - center, difference = a.measured - a.predicted;
    if (a.normal.isZero()) {
      const Eigen::Matrix<double, 3, 6> J = motionJacobian(arm);
      H += weight * J.transpose() * J;
      g += weight * J.transpose() * difference;
    } else {
      Vector6d row;  // of the motion's Jacobian along the normal
      row << arm.cross(a.normal), a.normal;
      H += weight * row * row.transpose();
      g += weight * row * a.normal.dot(difference);
    }
    size += weight * arm.squaredNorm();
  }
};

}  // namespace

AssociationRefs refsTo(const std::vector<Association>& associations) {
  AssociationRefs refs;
  refs.reserve(associations.size());
  for (const Association& association : associations) refs.push_back(&association);
  return refs;
}

Eigen::Isometry3d rigidStep(const AssociationRefs& associations, const std::vector<Association>& held) {
  if (associations.empty()) return Eigen::Isometry3d::Identity();
  MotionEquations equations;
  for (const Association* a : associations) equations.center += a->predicted;
  equations.center /= static_cast<double>(associations.size());

  const double scale = std::max(kSmallestScale, 2.0 * medianResidual(associations));
  for (const Association* a : associations) {
    const double ratio = a->residual() / scale;
    equations.add(*a, a->weight / (1.0 + ratio * ratio));
  }
  for (const Association& a : held) equations.add(a, a.weight);
  auto& [center, H, g, size] = equations;
  // A little of the mean stiffness in every direction: what the data does not fix does not move.
  H.topLeftCorner<3, 3>().diagonal().array() += 1e-3 * size + 1e-12;
  H.bottomRightCorner<3, 3>().diagonal().array() += 1e-3 * H.bottomRightCorner<3, 3>().trace() / 3.0 + 1e-12;
  const Vector6d motion = H.ldlt().solve(g);
  if (!motion.allFinite()) return Eigen::Isometry3d::Identity();

  const double angle = motion.head<3>().norm();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (angle > 0.0) T.linear() = Eigen::AngleAxisd(angle, motion.head<3>() / angle).toRotationMatrix();
  T.translation() = center + motion.tail<3>() - T.linear() * center;
  return T;
}

double rmsResidual(const std::vector<Association>& associations) {
  double sum = 0.0;
  for (const Association& a : associations) sum += a.residual() * a.residual();
  return associations.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(associations.size()));
}

double medianResidual(const AssociationRefs& associations) {
  if (associations.empty()) return 0.0;
  std::vector<double> residuals;
  const std::size_t step = 1 + associations.size() / kEnoughForMedian;
  residuals.reserve(associations.size() / step + 1);
  for (std::size_t i = 0; i < associations.size(); i += step)
    residuals.push_back(std::abs(associations[i]->residual()));
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return *middle;
}

}  // namespace softbody
