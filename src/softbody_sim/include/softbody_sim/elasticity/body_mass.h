#pragma once

#include "softbody_common/geometry/types.h"
#include "softbody_sim/object/material.h"

namespace softbody {

/// The mass of the tets with the densities of a material and its regions [kg].
/// @throw std::invalid_argument if the topology has no tets.
double bodyMass(const TetTopology& topology, const Material& material);

}  // namespace softbody
