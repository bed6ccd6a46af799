#include "dynamics/external_forces.h"

#include <algorithm>
#include <iterator>

#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

Points knownLoads(const Surroundings& surroundings, const SimulatorConfig& config, const BodyModel& model) {
  Points loads = model.masses * config.gravity.transpose();
  if (surroundings.loads.size() > 0) loads += surroundings.loads;
  return loads;
}

}  // namespace

Points unexplainedForces(const Surroundings& surroundings, const BodyState& body,
                         const SimulatorConfig& config, BodyModel* model) {
  Points forces = -knownLoads(surroundings, config, *model);
  model->solver->addElasticity(body.mesh.vertices, &forces);
  TargetEnergy contacts;
  model->constrained_step.setContactSprings(body.contact.contacts, &contacts);
  contacts.addTo(body.mesh.vertices, &forces);
  return forces;
}

ForceEstimate externalForces(const std::vector<Target>& targets, const Surroundings& surroundings,
                             const BodyState& body, const Material& material, const SimulatorConfig& config,
                             BodyModel* model) {
  std::vector<Target> measuring;
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(measuring),
               [](const Target& target) { return target.kind != TargetKind::kPrior; });
  TargetEnergy measured, contacts;
  const double variance = kTargetAccuracy_m * kTargetAccuracy_m;
  measured.set(measuring, model->topology.tets, 1.0 / variance);
  model->constrained_step.setContactSprings(body.contact.contacts, &contacts);
  std::vector<double> pin_stiffness;
  for (const Pin& pin : surroundings.pins) pin_stiffness.push_back(model->constrained_step.stiffnessOf(pin));
  const Points loads = knownLoads(surroundings, config, *model);
  return inKnownUnit(
      model->forceEstimator(config.elasticity)
          .estimate({body.mesh.vertices, measured, contacts, surroundings.pins, pin_stiffness, loads}),
      material);
}

}  // namespace softbody
