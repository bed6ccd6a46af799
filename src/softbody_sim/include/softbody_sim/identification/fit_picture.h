#pragma once

#include <opencv2/core.hpp>

#include "softbody_sim/identification/material_estimate.h"

namespace softbody {

/// The simulated body of the last observation, coloured by its distance from the measured places; beside it
/// the residual of each observation before and after the fit, and the forces if they were measured. @return
/// BGR.
/// @param problem whose estimate it is.
cv::Mat3b drawFit(const MaterialProblem& problem, const MaterialEstimate& estimate);

}  // namespace softbody
