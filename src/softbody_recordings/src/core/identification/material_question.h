#pragma once

#include <string>
#include <vector>

#include "softbody_sim/identification/material_problem.h"
#include "softbody_sim/object/object_model.h"

namespace softbody {

/// What a user wants to know of an object's material, and what is known.
struct MaterialQuestion {
  FreeProperties free;
  double mass_kg = 0.0;      ///< 0: not known
  double mass_std_kg = 0.0;  ///< 0: a hundredth of the mass
  SimulatorConfig simulator;
};

/// The problem without its observations. With a mass, the densities are scaled to it.
MaterialProblem problemOf(const ObjectModel& model, const MaterialQuestion& question);

/// e, nu, damping: what to find. @throw std::invalid_argument with the word and those that are allowed.
FreeProperties freePropertiesOf(const std::vector<std::string>& words);

}  // namespace softbody
