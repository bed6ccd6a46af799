#pragma once

#include <string>
#include <vector>

namespace softbody {

/// The elastic energy: corotated, stable neo-Hookean (Smith, de Goes, Kim 2018), or springs along the edges
/// of the tets, the mass-spring model. Only FEM offers the last two.
enum class Elasticity { kCorotated, kNeoHookean, kSprings };

/// The names of all: corotated, neo_hookean, springs.
const std::vector<std::string>& elasticityNames();
const std::string& nameOf(Elasticity elasticity);
/// @throw std::invalid_argument for another name.
Elasticity elasticityFromName(const std::string& name);

}  // namespace softbody
