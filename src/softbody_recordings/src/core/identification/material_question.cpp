#include "identification/material_question.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

/// The mass of the tets with the densities of a material [kg]. The last region that has a tet's centre
/// counts.
double massOf(const TetTopology& topology, const Material& material) {
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  double mass = 0.0;
  for (Eigen::Index t = 0; t < volumes.size(); ++t) {
    Eigen::Array3d center = Eigen::Array3d::Zero();
    for (int k = 0; k < 4; ++k)
      center += 0.25 * topology.rest_vertices.row(topology.tets(t, k)).transpose().array();
    double density = material.density_kg_m3;
    for (const MaterialRegion& region : material.regions)
      if ((center >= region.min.array()).all() && (center <= region.max.array()).all())
        density = region.density_kg_m3;
    mass += density * volumes[t];
  }
  return mass;
}

}  // namespace

MaterialProblem problemOf(const ObjectModel& model, const MaterialQuestion& question) {
  MaterialProblem problem;
  problem.topology = model.volume;
  problem.prior = model.material;
  problem.prior.youngs_modulus_std_pa.reset();
  problem.simulator = question.simulator;
  problem.free = question.free;
  if (!(question.mass_kg > 0.0)) return problem;
  const double factor = question.mass_kg / massOf(model.volume, model.material);
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
