#pragma once

#include <Eigen/Geometry>

#include "softbody_evaluation/models/model.h"

namespace softbody::evaluation {

/// The rigid motion of the scanned surface onto the true one [m]. It starts at 96 rotations of the principal
/// axes and keeps the best by distance in both directions. Point-to-plane ICP (Chen and Medioni 1992) with
/// Geman and McClure's weights: what one of the surfaces lacks does not pull. Places that were never seen do
/// not count. A body that looks the same in several poses has several right answers.
/// @throw std::invalid_argument if the sizes differ by more than three times.
Eigen::Isometry3d fitModel(const Model& scanned, const Model& truth);

}  // namespace softbody::evaluation
