#pragma once

#include <vector>

#include "dynamics/body_model.h"
#include "dynamics/body_state.h"
#include "softbody_sim/forces/force_estimate.h"

namespace softbody {

/// Forces that hold the body in its shape besides gravity, contacts and known loads, #V by 3 [N]. Those of
/// pins are among them.
Points unexplainedForces(const Surroundings& surroundings, const BodyState& body,
                         const SimulatorConfig& config, BodyModel* model);

/// What explains the shape of a body besides gravity, pins, obstacles and known loads. Targets of kind PRIOR
/// measure nothing. @throw std::runtime_error as ForceEstimator does.
ForceEstimate externalForces(const std::vector<Target>& targets, const Surroundings& surroundings,
                             const BodyState& body, const Material& material, const SimulatorConfig& config,
                             BodyModel* model);

}  // namespace softbody
