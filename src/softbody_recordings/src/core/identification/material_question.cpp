#include "identification/material_question.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "softbody_sim/elasticity/body_mass.h"

namespace softbody {

MaterialProblem problemOf(const ObjectModel& model, const MaterialQuestion& question) {
  MaterialProblem problem;
  problem.topology = model.volume;
  problem.prior = model.material;
  problem.prior.youngs_modulus_std_pa.reset();
  problem.simulator = question.simulator;
  problem.free = question.free;
  if (!(question.mass_kg > 0.0)) return problem;
  const double factor = question.mass_kg / bodyMass(model.volume, model.material);
  problem.prior.density_kg_m3 *= factor;
  for (MaterialRegion& region : problem.prior.regions) region.density_kg_m3 *= factor;
  problem.mass_std = question.mass_std_kg > 0.0 ? question.mass_std_kg / question.mass_kg : 0.01;
  return problem;
}

FreeProperties freePropertiesOf(const std::vector<std::string>& words) {
  FreeProperties free;
  free.youngs_modulus = false;
  for (const std::string& word : words) {
    bool* property = word == "e" ? &free.youngs_modulus : word == "nu" ? &free.poisson_ratio : nullptr;
    if (word == "damping") property = &free.damping;
    if (property == nullptr)
      throw std::invalid_argument(fmt::format("'{}' is no property; allowed: e, nu, damping", word));
    *property = true;
  }
  return free;
}

}  // namespace softbody
