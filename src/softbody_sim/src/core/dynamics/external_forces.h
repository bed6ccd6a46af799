#pragma once

#include <vector>

#include "dynamics/body_model.h"
#include "dynamics/body_state.h"
#include "softbody_sim/forces/force_estimate.h"

namespace softbody {

/// What explains the shape of a body besides gravity, pins, obstacles and known loads. Targets of kind PRIOR
/// measure nothing. @throw std::runtime_error as ForceEstimator does.
ForceEstimate externalForces(const std::vector<Target>& targets, const Surroundings& surroundings,
                             const BodyState& body, const Material& material, const SimulatorConfig& config,
                             BodyModel* model);

}  // namespace softbody
