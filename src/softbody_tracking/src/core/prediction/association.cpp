#include "prediction/association.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/statistics/median.h"
#include "softbody_common/statistics/robust.h"

namespace softbody {
namespace {

// Associations that a median needs; of more only a part is used, to save time.
constexpr std::size_t kEnoughForMedian = 500;
// Smallest median residual [m]: measurements are not more precise than that.
constexpr double kSmallestMedian = 0.001;
// Smallest scale of a rigid step's Cauchy weights [m]: residuals below the depth noise are no outliers.
constexpr double kSmallestScale = 0.003;
// Stiffness added in every direction, as a share of the mean: a direction without data does not move.
constexpr double kRegularization = 1e-3;
// Absolute part of it, for data that fix nothing.
constexpr double kSmallestStiffness = 1e-12;

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
      Vector6d row;  // Jacobian along the normal
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
    equations.add(*a, cauchyWeighted(a->weight, ratio * ratio));
  }
  for (const Association& a : held) equations.add(a, a.weight);
  auto& [center, H, g, size] = equations;
  H.topLeftCorner<3, 3>().diagonal().array() += kRegularization * size + kSmallestStiffness;
  H.bottomRightCorner<3, 3>().diagonal().array() +=
      kRegularization * H.bottomRightCorner<3, 3>().trace() / 3.0 + kSmallestStiffness;
  const Vector6d motion = H.ldlt().solve(g);
  if (!motion.allFinite()) return Eigen::Isometry3d::Identity();
  return rigidMotion(motion.head<3>(), motion.tail<3>(), center);
}

void weighByResidual(double scale, std::vector<Association>* associations) {
  const double usual = std::max(kSmallestMedian, medianResidual(refsTo(*associations)));
  const double length = scale * usual;
  for (Association& association : *associations) {
    const double ratio = association.residual() / length;
    association.weight = cauchyWeighted(association.weight, ratio * ratio);
  }
}

double rmsResidual(const std::vector<Association>& associations) {
  double sum = 0.0;
  for (const Association& a : associations) sum += a.residual() * a.residual();
  return associations.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(associations.size()));
}

double medianResidual(const AssociationRefs& associations) {
  std::vector<double> residuals;
  const std::size_t step = 1 + associations.size() / kEnoughForMedian;
  residuals.reserve(associations.size() / step + 1);
  for (std::size_t i = 0; i < associations.size(); i += step)
    residuals.push_back(std::abs(associations[i]->residual()));
  return median(&residuals);
}

}  // namespace softbody
