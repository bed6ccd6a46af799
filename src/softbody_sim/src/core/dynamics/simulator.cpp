#include "softbody_sim/dynamics/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "constraints/contact_patches.h"
#include "dynamics/external_forces.h"
#include "dynamics/simulator_implementation.h"
#include "dynamics/target_validation.h"
#include "estimation/standard_deviation.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/time/time.h"
#include "softbody_common/time/timeline.h"

namespace softbody {

Simulator::Implementation::Implementation(const TetTopology& topology, const Material& material_in,
                                          const SimulatorConfig& config_in)
    : uncut(topology),
      material(material_in),
      config(config_in),
      edge_length(meanEdgeLength(topology.rest_vertices, topology.tets)),
      integrator(config_in, material_in.damping) {
  requireUsedRegions(topology, material_in);
  setTopology(topology);
}

void Simulator::Implementation::setTopology(const TetTopology& topology) {
  if (model && model->hasTets(topology))
    model->topology.revision = topology.revision;
  else
    makeModel(topology, material, config);
  body.mesh.revision = topology.revision;
}

/// The model of a body with many cuts takes most of the memory, so the old one goes first. If the new one
/// cannot be made, the old one comes back.
void Simulator::Implementation::makeModel(const TetTopology& topology, const Material& next_material,
                                          const SimulatorConfig& next_config) {
  const TetTopology before = model ? std::move(model->topology) : topology;
  model.reset();
  try {
    model = std::make_unique<BodyModel>(topology, next_material, next_config, edge_length);
  } catch (...) {
    model = std::make_unique<BodyModel>(before, material, config, edge_length);
    throw;
  }
}

const TargetSet& Simulator::Implementation::toCurrentRevision(const TargetSet& targets,
                                                              TargetSet* storage) const {
  if (targets.revision == model->topology.revision) return targets;
  *storage = recent.toCurrentRevision(targets);
  return *storage;
}

void Simulator::Implementation::requireUsable(const TargetSet& targets,
                                              const Surroundings& surroundings) const {
  if (!body.placed && !targets.reset)
    throw std::invalid_argument("the body is not placed yet: waiting for targets with reset and a body_pose");
  softbody::requireUsable(targets, model->topology, largestStiffness(config) / config.target_stiffness);
  softbody::requireUsable(surroundings, model->topology.rest_vertices.rows());
}

void Simulator::Implementation::place(const Eigen::Isometry3d& pose, Nanoseconds stamp) {
  placeAtRest(model->topology.rest_vertices, pose, stamp, &next);
}

void Simulator::Implementation::advance(const std::vector<Target>& targets, Nanoseconds stamp,
                                        const Surroundings& surroundings) {
  const double elapsed_s = std::max(0.0, seconds(stamp - next.stamp));
  integrator.step(model.get(), targets, elapsed_s, surroundings, &next);
  // A step without images may be ahead of the next image, but not by much.
  next.stamp = next.stamp - stamp > Timeline::kLeap ? stamp : std::max(next.stamp, stamp);
}

/// Without elapsed time the targets are those of an earlier estimate, or nothing moves: the loads stay.
void Simulator::Implementation::estimate(const std::vector<Target>& targets, const Surroundings& surroundings,
                                         double elapsed_s) {
  model->vertex_confidence.compute(targets, &next.mesh.confidence);
  if (config.load_fade_s <= 0.0) return;
  const Points& vertices = next.mesh.vertices;
  LoadEstimate loads = next.loads;
  const auto posterior = model->load_estimator.update(
      targets, surroundings.pins, vertices, unexplainedForces(surroundings, next, config, model.get()),
      elapsed_s, &loads);
  if (elapsed_s > 0.0) next.loads = std::move(loads);
  if (posterior)
    standardDeviations(targets, model->topology.tets, vertices, *posterior, &next.mesh.standard_deviation);
}

Simulator::Simulator(const TetTopology& topology, const Material& material, const SimulatorConfig& config)
    : implementation_(std::make_unique<Implementation>(topology, material, config)) {}

Simulator::Simulator(Simulator&& other) noexcept = default;
Simulator& Simulator::operator=(Simulator&& other) noexcept = default;
Simulator::~Simulator() = default;

const TetTopology& Simulator::topology() const { return implementation_->model->topology; }
const Material& Simulator::material() const { return implementation_->material; }
bool Simulator::placed() const { return implementation_->body.placed; }

void Simulator::prepare() {
  if (implementation_->config.load_fade_s > 0.0) implementation_->model->load_estimator.prepare();
}

/// The uncut body comes back when a recording starts again.
void Simulator::requireUsable(const TargetSet& targets) const {
  const Implementation& s = *implementation_;
  const double largest_weight = largestStiffness(s.config) / s.config.target_stiffness;
  TargetSet storage;
  const TargetSet& current = s.toCurrentRevision(targets, &storage);
  const bool fits = current.revision == s.model->topology.revision;
  softbody::requireUsable(fits ? current : targets, fits ? s.model->topology : s.uncut, largest_weight);
  static const Points kNotPlaced;
  requireWithinReach(fits ? current : targets, fits ? s.model->topology : s.uncut,
                     fits && !targets.reset ? s.body.mesh.vertices : kNotPlaced);
}

void Simulator::step(const TargetSet& given, Nanoseconds stamp, const Surroundings& surroundings) {
  Implementation& s = *implementation_;
  TargetSet storage;
  const TargetSet& targets = s.toCurrentRevision(given, &storage);
  s.requireUsable(targets, surroundings);
  static const Points kNotPlaced;
  requireWithinReach(targets, s.model->topology, targets.reset ? kNotPlaced : s.body.mesh.vertices);
  s.next = s.body;
  if (targets.reset) s.place(targets.body_pose, stamp);
  std::vector<Target> storage_of_means;
  const std::vector<Target>& means =
      s.model->shape_memory.recall(targets.targets, s.next.mesh.vertices, seconds(stamp - s.next.stamp),
                                   &s.next.memory, &storage_of_means);
  s.advance(means, stamp, surroundings);
  s.estimate(means, surroundings, std::max(0.0, seconds(stamp - s.body.stamp)));
  if (!targets.targets.empty()) s.next.mesh.observed = stamp;
  std::swap(s.body, s.next);
}

bool Simulator::hasLeft(const TargetSet& given) const {
  const Implementation& s = *implementation_;
  if (!s.body.placed) return false;
  TargetSet storage;
  const TargetSet& targets = s.toCurrentRevision(given, &storage);
  s.requireUsable(targets, {});
  return softbody::hasLeft(targets, s.model->topology, s.body.mesh.vertices);
}

void Simulator::stepUnobserved(const TargetSet& given, Nanoseconds stamp, const Surroundings& surroundings) {
  Implementation& s = *implementation_;
  TargetSet storage;
  const TargetSet& earlier = s.toCurrentRevision(given, &storage);
  s.requireUsable(earlier, surroundings);
  if (!s.body.placed) throw std::invalid_argument("the body is not placed yet");
  s.next = s.body;
  s.advance(earlier.targets, stamp, surroundings);
  fadeUnobserved(seconds(s.next.stamp - s.body.stamp), &s.next.mesh);
  std::swap(s.body, s.next);
}

void Simulator::settle(const TargetSet& given, const Surroundings& surroundings) {
  Implementation& s = *implementation_;
  TargetSet storage;
  const TargetSet& targets = s.toCurrentRevision(given, &storage);
  s.requireUsable(targets, surroundings);
  s.next = s.body;
  if (targets.reset) s.place(targets.body_pose, s.body.stamp);
  s.integrator.settle(s.model.get(), targets.targets, surroundings, &s.next);
  s.estimate(targets.targets, surroundings, 0.0);
  std::swap(s.body, s.next);
}

void Simulator::setVertices(const Points& vertices) {
  BodyState& body = implementation_->body;
  if (!body.placed) throw std::invalid_argument("the body is not placed yet");
  if (vertices.rows() != body.mesh.vertices.rows() || !vertices.allFinite()) {
    throw std::invalid_argument(fmt::format("{} vertices for a body of {}, or they are not finite",
                                            vertices.rows(), body.mesh.vertices.rows()));
  }
  body.mesh.vertices = vertices;
  body.velocity.setZero();
  body.contact = {};
}

void Simulator::change(const Material& material, const SimulatorConfig& config) {
  Implementation& s = *implementation_;
  softbody::requireUsable(material);
  requireUsedRegions(s.uncut, material);
  requireConsistent(config);
  ImplicitEuler integrator(config, material.damping);
  s.makeModel(TetTopology(s.model->topology), material, config);
  s.integrator = std::move(integrator);
  s.material = material;
  s.config = config;
  s.body.contact.contacts.clear();  // a depth gives another pressure now
  s.body.memory = {};
  if (config.load_fade_s <= 0.0) s.body.mesh.standard_deviation.clear();
  if (s.body.placed) s.body.loads = {Points::Zero(s.body.mesh.vertices.rows(), 3)};
}

void Simulator::setMaterial(const Material& material) { change(material, config()); }

const SimulatorConfig& Simulator::config() const { return implementation_->config; }

void Simulator::setConfig(const SimulatorConfig& config) {
  Implementation& s = *implementation_;
  LoadEstimate loads = s.body.loads;
  change(s.material, config);
  if (config.load_fade_s > 0.0) s.body.loads = std::move(loads);
}

std::unique_ptr<Simulator> Simulator::copyOfPresent() const { return copyWith(implementation_->config); }

std::unique_ptr<Simulator> Simulator::copyWith(const SimulatorConfig& config) const {
  const Implementation& s = *implementation_;
  auto copy = std::make_unique<Simulator>(s.uncut, s.material, config);
  copy->implementation_->setTopology(s.model->topology);
  copy->implementation_->body = s.body;
  return copy;
}

std::unique_ptr<Simulator> Simulator::copyForPrediction() const {
  return copyWith(configForPrediction(implementation_->config));
}

void Simulator::returnTo(const Simulator& other) {
  implementation_->body = other.implementation_->body;
  implementation_->model->constrained_step.restart(implementation_->body.mesh.vertices);
}

void Simulator::reset() {
  Implementation& s = *implementation_;
  s.body = {};
  s.model->constrained_step.restart(s.model->topology.rest_vertices);
  s.recent.clear();
  if (s.model->topology.revision != s.uncut.revision) s.setTopology(s.uncut);
  s.body.mesh.revision = s.uncut.revision;
}

void Simulator::apply(const TetEdits& edits) {
  Implementation& s = *implementation_;
  BodyState next = s.body;
  const TetTopology before = s.model->topology;
  const TetTopology* at = &before;
  for (const std::shared_ptr<const TetEdit>& edit : edits) {
    if (edit->successors.size() != static_cast<std::size_t>(at->tets.rows())) {
      throw std::invalid_argument(fmt::format("the edit is of {} tets, but the body has {}",
                                              edit->successors.size(), at->tets.rows()));
    }
    if (next.placed) transferToEdit(*edit, at->tets, &next);
    at = &edit->topology;
  }
  s.setTopology(*at);
  if (next.placed) s.model->load_estimator.balance(next.mesh.vertices, &next.loads.per_mass);
  next.mesh.revision = at->revision;
  s.recent.add(before, edits);
  s.body = std::move(next);
}

Nanoseconds Simulator::stamp() const { return implementation_->body.stamp; }

TargetSet Simulator::toCurrentRevision(TargetSet targets) const {
  return implementation_->recent.toCurrentRevision(std::move(targets));
}

const MeshState& Simulator::state() const { return implementation_->body.mesh; }
const StepReport& Simulator::report() const { return implementation_->body.report; }
const Reactions& Simulator::reactions() const { return implementation_->body.reactions; }

std::vector<ContactPatch> Simulator::contactPatches() const {
  const Implementation& s = *implementation_;
  return patchesOf(s.model->constrained_step.contactForces(s.body.contact, s.body.mesh.vertices),
                   s.model->topology.tets);
}

ForceEstimate Simulator::externalForces(const TargetSet& given, const Surroundings& surroundings) {
  Implementation& s = *implementation_;
  if (!s.body.placed) throw std::invalid_argument("the body is not placed yet");
  TargetSet storage;
  const TargetSet& targets = s.toCurrentRevision(given, &storage);
  s.requireUsable(targets, surroundings);
  return softbody::externalForces(targets.targets, surroundings, s.body, s.material, s.config, s.model.get());
}

double Simulator::elasticEnergy() const {
  const Points& x = implementation_->body.mesh.vertices;
  Points unused = Points::Zero(x.rows(), 3);
  return implementation_->model->solver->addElasticity(x, &unused);
}

}  // namespace softbody
