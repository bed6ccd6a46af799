#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// A material point, where the prediction puts it and where the frame shows it; camera frame [m].
struct Association {
  TargetKind kind = TargetKind::kDepth;
  MaterialPoint place;
  std::uint32_t body = 0;  ///< connected piece of the body
  Eigen::Vector3d predicted = Eigen::Vector3d::Zero();
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  ///< unit: only the distance along it counts; zero: all three
  double weight = 1.0;

  /// Signed distance along the normal, or plain distance [m].
  double residual() const {
    return normal.isZero() ? (measured - predicted).norm() : normal.dot(measured - predicted);
  }
};

/// Of associations that stay where they are.
using AssociationRefs = std::vector<const Association*>;
AssociationRefs refsTo(const std::vector<Association>& associations);

/// d(point moved by (rotation, translation)) = J (rotation, translation), about the centre.
/// @param arm from the centre to the point.
inline Eigen::Matrix<double, 3, 6> motionJacobian(const Eigen::Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> J;
  J << 0.0, arm.z(), -arm.y(), 1.0, 0.0, 0.0,  //
      -arm.z(), 0.0, arm.x(), 0.0, 1.0, 0.0,   //
      arm.y(), -arm.x(), 0.0, 0.0, 0.0, 1.0;
  return J;
}

/// The small rigid motion that best takes predictions to measurements: one Gauss-Newton step with Cauchy
/// weights (point-to-plane where there is a normal, point-to-point elsewhere; Chen and Medioni 1992).
/// @param held draws back by its weights alone: nothing of it is an outlier, nor says what is one.
/// @return identity where the associations do not fix a motion at all.
Eigen::Isometry3d rigidStep(const AssociationRefs& associations, const std::vector<Association>& held = {});

/// Root mean square of the residuals [m]; 0 for none.
double rmsResidual(const std::vector<Association>& associations);

/// Median of the absolute residuals [m]; 0 for none. Of 500 or more every second, third, ... counts.
double medianResidual(const AssociationRefs& associations);

}  // namespace softbody
