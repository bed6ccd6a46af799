#pragma once

#include <Eigen/Geometry>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The rigid motion T that minimises sum_i w_i |target_i - T source_i|^2 (Kabsch; Kang et al. 2022, eq. 1-2).
/// T_R = U diag(1, 1, det(U V^T)) V^T makes T a rotation, never a reflection.
/// @param weights one per row, >= 0; if empty, all are 1.
/// @throw std::invalid_argument if sizes differ, no weight is positive, or a value is not finite.
Eigen::Isometry3d fitRigid(const Points& source, const Points& target, const Eigen::VectorXd& weights = {});

/// The points (rows), transformed by T.
Points transformed(const Points& points, const Eigen::Isometry3d& T);

}  // namespace softbody
