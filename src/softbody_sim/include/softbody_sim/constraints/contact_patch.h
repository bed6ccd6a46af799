#pragma once

#include <Eigen/Core>

namespace softbody {

/// A connected part of the body's surface that presses on one obstacle, in the targets' frame.
struct ContactPatch {
  int obstacle = -1;                                  ///< index
  Eigen::Vector3d place = Eigen::Vector3d::Zero();    ///< centre of the forces' sizes [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the obstacle, towards the body; unit
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< of the body on the obstacle [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();   ///< about the place [N m]
};

}  // namespace softbody
