#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/contact_patch.h"

namespace softbody {

/// The force of one contact point.
struct PointForce {
  MaterialPoint place;
  int obstacle = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the body's point [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< of the obstacle
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< of the body on the obstacle [N]
};

/// Joins the points on one obstacle whose surface triangles touch. @param points in order of their obstacles.
std::vector<ContactPatch> patchesOf(const std::vector<PointForce>& points, const Tets& tets);

}  // namespace softbody
