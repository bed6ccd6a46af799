#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/object/material.h"

namespace softbody {

/// The external force on a connected part of the body's surface, in the targets' frame.
struct ForcePatch {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();    ///< mean, weighted by the sizes of the forces [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the surface there, out of the body; unit
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< on the body [N]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// The forces that explain the shape of an observed body, besides gravity, pins, obstacles and known loads.
struct ForceEstimate {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  bool in_newtons = true;            ///< false: forces of patches and wrench are divided by Young's modulus
  std::vector<ForcePatch> patches;   ///< the largest first
  Vector6 wrench = Vector6::Zero();  ///< their sum: force [N], torque about the origin [N m]
  Matrix6 wrench_covariance = Matrix6::Zero();  ///< of the wrench
  std::vector<Wrench> pins;  ///< the body's forces on the pins, without the springs of the targets [N]
};

/// The wrench and its covariance in another frame, about its origin; patches and pins stay. @param pose of
/// that frame.
ForceEstimate withWrenchIn(ForceEstimate estimate, const Eigen::Isometry3d& pose);

/// The estimate in newtons, or in units of Young's modulus if its standard deviation is not known. A known
/// standard deviation adds to the covariances, because forces grow with the stiffness. @param estimate in
/// newtons, for this material.
ForceEstimate inKnownUnit(ForceEstimate estimate, const Material& material);

}  // namespace softbody
