#pragma once

#include <string>
#include <vector>

#include "identification/seen_frame.h"
#include "softbody_sim/identification/material_estimate.h"

namespace softbody {

/// What the found material says of the sensors: a line for each that reads a constant force too much (bias),
/// or one that grows with time (drift), by more than four of its standard errors.
std::string sensorSentences(const MaterialProblem& problem, const MaterialEstimate& estimate,
                            const std::vector<WrenchRecord>& records);

}  // namespace softbody
