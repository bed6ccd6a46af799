#pragma once

#include <Eigen/Core>
#include <vector>

#include "prediction/association.h"
#include "prediction/rigid_prediction.h"

namespace softbody {

/// For each piece, the share of its rigid motion that a frame measures. A direction that is measured to the
/// standard deviation s has the share 1 / (1 + (s / 1 mm)^2): more than 1 mm may as well be an error of the
/// shape.
/// @param associations camera frame. @param pieces vertices of each piece, camera frame [m].
/// @param R_fixed_camera turns the shares into the fixed frame.
std::vector<MotionShare> measuredShares(const std::vector<Association>& associations,
                                        const std::vector<Points>& pieces,
                                        const Eigen::Matrix3d& R_fixed_camera);

}  // namespace softbody
