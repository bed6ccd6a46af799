#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Standard deviation of a measurement of weight 1 [m].
constexpr double kUnitDeviation = 0.001;

/// A material point, its predicted and its measured position; camera frame [m].
struct Association {
  TargetKind kind = TargetKind::kDepth;
  MaterialPoint place;
  std::uint32_t piece = 0;  ///< connected piece of the body
  Eigen::Vector3d predicted = Eigen::Vector3d::Zero();
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  ///< unit: only the distance along it counts; zero: all directions count
  double weight = 1.0;

  /// Signed distance along the normal, or plain distance [m].
  double residual() const {
    return normal.isZero() ? (measured - predicted).norm() : normal.dot(measured - predicted);
  }
};

/// References to associations that outlive them.
using AssociationRefs = std::vector<const Association*>;
AssociationRefs refsTo(const std::vector<Association>& associations);

/// The small rigid motion from predictions to measurements: one Gauss-Newton step with Cauchy weights
/// (point-to-plane with a normal, point-to-point without; Chen and Medioni 1992).
/// @param held further associations with full weight; they do not change the scale of the Cauchy weights.
/// @return identity if the associations do not determine a motion.
Eigen::Isometry3d rigidStep(const AssociationRefs& associations, const std::vector<Association>& held = {});

/// Scale of the robust loss of depth and contours, in median residuals.
constexpr double kRobustScale = 4.0;

/// Robust loss (Cauchy): reduces the weights of associations whose residuals are large beside the others'.
/// @param scale in median residuals, which are at least 1 mm: there the weight is halved.
void weighByResidual(double scale, std::vector<Association>* associations);

/// Root mean square of the residuals [m]; 0 for none.
double rmsResidual(const std::vector<Association>& associations);

/// Median of the absolute residuals [m]; 0 for none. From 500 associations on, only every second, third, ...
/// is used.
double medianResidual(const AssociationRefs& associations);

}  // namespace softbody
