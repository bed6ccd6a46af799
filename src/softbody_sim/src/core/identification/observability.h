#pragma once

#include <string>

#include "identification/material_fit.h"
#include "softbody_sim/identification/material_estimate.h"

namespace softbody {

/// How the simulated body of a fit deforms.
struct SeenDeformation {
  double rms_m = 0.0;    ///< of the simulated places, from the rigid body
  bool is_shown = true;  ///< the residuals of the deforming body are clearly smaller than the rigid one's
};

/// @param factor of the variance, for errors that are not independent.
SeenDeformation deformationOf(const MaterialProblem& problem, const MaterialFit& fit, double factor);

/// Why nothing gives the scale of the stiffness, and what is known. Empty: something does.
std::string whyWithoutScale(const MaterialProblem& problem);

/// Why an unknown is not observable although the data have a scale. @param error its standard error.
std::string whyUncertain(const Unknown& unknown, double error, const SeenDeformation& deformation);

}  // namespace softbody
