#include "softbody_sim/dynamics/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "cutting/volume/edited_volume.h"
#include "dynamics/body_model.h"
#include "dynamics/surface_follower.h"
#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_locator.h"
#include "time_step/step_potential.h"

namespace softbody {
namespace {

/// The frame interval that Material::damping refers to, and the inertia of a step that takes no time.
constexpr double kNominalTimeStep = 1.0 / 30.0;

/// Beyond it a target lies so far out of its tet that it says nothing about the tet, and its square in the
/// metric drowns the body's own stiffness.
constexpr double kLargestBarycentric = 100.0;

/// To the microsecond: stamps of frames at 30 Hz are 33,333,333 or 33,333,334 ns apart, and one factor serves
/// both.
double timeStep(double elapsed_s) { return std::max(1.0, std::round(1e6 * elapsed_s)) * 1e-6; }

void requireUsableTarget(const Target& target, std::size_t index, Eigen::Index tet_count,
                         double largest_weight) {
  if (target.place.tet < 0 || target.place.tet >= tet_count) {
    throw std::invalid_argument(
        fmt::format("targets[{}] names tet {} of {}", index, target.place.tet, tet_count));
  }
  const bool finite = target.place.barycentric.allFinite() && target.position.allFinite() &&
                      target.normal.allFinite() && std::isfinite(target.weight);
  if (!finite) throw std::invalid_argument(fmt::format("targets[{}] is not finite", index));
  if (target.weight <= 0.0 || target.weight > largest_weight) {
    throw std::invalid_argument(fmt::format("targets[{}] has the weight {}: must be above 0 and at most {}",
                                            index, target.weight, largest_weight));
  }
  if (target.place.barycentric.cwiseAbs().maxCoeff() > kLargestBarycentric) {
    throw std::invalid_argument(fmt::format("targets[{}] has a barycentric coordinate beyond {} either way",
                                            index, kLargestBarycentric));
  }
}

/// All that a step changes.
struct Body {
  bool placed = false;
  Nanoseconds stamp = 0;
  Points velocity;  ///< [m/s]
  Points loads;     ///< unknown ones from outside, as estimated, per mass [m/s^2]
  MeshState state;
  StepReport report;
  Reactions reactions;
  std::vector<Eigen::Isometry3d> obstacle_poses;  ///< at the end of the last step; none: as they are now
};

bool sameTets(const TetTopology& a, const TetTopology& b) {
  return a.tets.rows() == b.tets.rows() && a.rest_vertices.rows() == b.rest_vertices.rows() &&
         a.tets == b.tets && a.rest_vertices == b.rest_vertices;
}

/// Every vertex stays, or appears, where its material was, and moves as that did.
void carryOver(const TetEdit& edit, const Tets& tets, Body* body) {
  std::vector<float> confidence;
  for (const MaterialPoint& origin : edit.vertex_origins) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
      sum += origin.barycentric[k] * body->state.confidence[static_cast<std::size_t>(tets(origin.tet, k))];
    confidence.push_back(static_cast<float>(sum));
  }
  body->state.confidence = std::move(confidence);
  body->state.vertices = applyBinding(edit.vertex_origins, body->state.vertices, tets);
  body->velocity = applyBinding(edit.vertex_origins, body->velocity, tets);
  body->loads = applyBinding(edit.vertex_origins, body->loads, tets);
}

}  // namespace

struct Simulator::Implementation {
  Implementation(const TetTopology& topology, const Material& material_in, const SimulatorConfig& config_in);

  void requireUsable(const TargetSet& targets, const Surroundings& surroundings) const;
  void place(const Eigen::Isometry3d& pose, Nanoseconds stamp, Body* next) const;
  void advance(const TargetSet& targets, Nanoseconds stamp, const Surroundings& surroundings, Body* next);
  void simulate(const TargetSet& targets, double elapsed_s, const Surroundings& surroundings, Body* next);
  void estimateLoads(const TargetSet& targets, double elapsed_s, Body* next);
  void settle(const TargetSet& targets, const Surroundings& surroundings, Body* next);
  /// From `solution`, which becomes the next vertices, under `free`.
  void solve(const TargetSet& targets, const Surroundings& surroundings, Body* next);

  void adopt(const TetTopology& topology);
  /// The targets for the present revision; `storage` holds them where they were for an earlier one.
  const TargetSet& upToDate(const TargetSet& targets, TargetSet* storage) const;

  const TetTopology uncut;
  const Material material;
  const SimulatorConfig config;
  const double edge_length;  ///< mean, of the uncut body [m]

  EditedVolume volume;
  std::unique_ptr<BodyModel> model;  ///< of the volume's topology
  Body body;

  // Kept from step to step, so that steps allocate nothing.
  Body next;
  StepPotential free;  ///< without targets and surroundings
  Points solution;
  std::vector<Eigen::Isometry3d> poses;  ///< of the obstacles
  TargetEnergy springs;
  Points spring_forces;
};

Simulator::Implementation::Implementation(const TetTopology& topology, const Material& material_in,
                                          const SimulatorConfig& config_in)
    : uncut(topology),
      material(material_in),
      config(config_in),
      edge_length(meanEdgeLength(topology.rest_vertices, topology.tets)),
      volume(topology) {
  adopt(topology);
}

void Simulator::Implementation::adopt(const TetTopology& topology) {
  if (model && sameTets(model->topology, topology))
    model->topology.revision = topology.revision;
  else
    model = std::make_unique<BodyModel>(topology, material, config, edge_length);
  body.state.revision = topology.revision;
}

const TargetSet& Simulator::Implementation::upToDate(const TargetSet& targets, TargetSet* storage) const {
  if (targets.revision == model->topology.revision) return targets;
  *storage = volume.broughtUpToDate(targets);
  return *storage;
}

void Simulator::Implementation::requireUsable(const TargetSet& targets,
                                              const Surroundings& surroundings) const {
  if (targets.revision != model->topology.revision) {
    throw std::invalid_argument(fmt::format("targets are for revision {} of the volume, which is at {}",
                                            targets.revision, model->topology.revision));
  }
  if (!body.placed && !targets.reset) {
    throw std::invalid_argument("the body has no place yet: waiting for targets with reset and a body_pose");
  }
  if (targets.reset && !targets.body_pose.matrix().allFinite())
    throw std::invalid_argument("body_pose is not finite");
  for (std::size_t i = 0; i < targets.targets.size(); ++i) {
    requireUsableTarget(targets.targets[i], i, model->topology.tets.rows(),
                        largestStiffness(config) / config.target_stiffness);
  }
  softbody::requireUsable(surroundings, model->topology.rest_vertices.rows());
}

void Simulator::Implementation::place(const Eigen::Isometry3d& pose, Nanoseconds stamp, Body* next) const {
  next->state.vertices = transformed(model->topology.rest_vertices, pose);
  next->velocity = next->loads = Points::Zero(next->state.vertices.rows(), 3);
  next->stamp = stamp;
  next->placed = true;
  next->obstacle_poses.clear();  // no way leads from where they were before
}

void Simulator::Implementation::advance(const TargetSet& targets, Nanoseconds stamp,
                                        const Surroundings& surroundings, Body* next) {
  if (config.simulate) {
    const double elapsed_s = std::max(0.0, 1e-9 * static_cast<double>(stamp - next->stamp));
    simulate(targets, elapsed_s, surroundings, next);
  } else {
    followTargets(targets.targets, model->topology, &next->state.vertices);
    next->report = {0, true};
  }
  next->stamp = std::max(next->stamp, stamp);
}

void Simulator::Implementation::simulate(const TargetSet& targets, double elapsed_s,
                                         const Surroundings& surroundings, Body* next) {
  const double h = elapsed_s > 0.0 ? timeStep(std::min(elapsed_s, config.max_time_step_s)) : kNominalTimeStep;
  free.inertia = model->masses / (h * h);
  free.prediction = next->state.vertices;
  free.loads.setZero(model->masses.size(), 3);
  if (elapsed_s > 0.0) {
    next->velocity *= std::pow(1.0 - material.damping, h / kNominalTimeStep);
    model->unseen_pieces.slow(targets.targets, elapsed_s, &next->velocity);
    free.prediction += h * next->velocity;
    free.loads.noalias() = model->masses * config.gravity.transpose();
  }
  // From where gravity alone takes the vertices; the body's stiffness meets the estimated loads.
  solution = free.prediction + free.inertia.cwiseInverse().asDiagonal() * free.loads;
  if (elapsed_s > 0.0) free.loads += model->masses.asDiagonal() * next->loads;
  solve(targets, surroundings, next);
  // Over a gap that is simulated as a shorter step the body still took the whole gap for its way.
  if (elapsed_s > 0.0) {
    const double passed_s = elapsed_s > config.max_time_step_s ? elapsed_s : h;
    next->velocity = (solution - next->state.vertices) / passed_s;
  }
  next->state.vertices.swap(solution);
}

/// What the targets still pull with says what else acts on the body.
void Simulator::Implementation::estimateLoads(const TargetSet& targets, double elapsed_s, Body* next) {
  springs.set(targets.targets, model->topology.tets, model->target_stiffness);
  spring_forces.setZero(next->loads.rows(), 3);
  springs.addTo(next->state.vertices, &spring_forces);
  spring_forces *= -1.0;
  model->load_estimate.update(spring_forces, next->state.vertices, elapsed_s, &next->loads);
}

void Simulator::Implementation::settle(const TargetSet& targets, const Surroundings& surroundings,
                                       Body* next) {
  if (targets.reset) place(targets.body_pose, next->stamp, next);
  free.inertia.setZero(model->masses.size());
  free.prediction = solution = next->state.vertices;
  free.loads.noalias() = model->masses * config.gravity.transpose();
  solve(targets, surroundings, next);
  next->state.vertices.swap(solution);
  next->velocity.setZero();
}

void Simulator::Implementation::solve(const TargetSet& targets, const Surroundings& surroundings,
                                      Body* next) {
  poses.clear();
  for (const Obstacle& obstacle : surroundings.obstacles) poses.push_back(obstacle.pose);
  if (next->obstacle_poses.size() != poses.size()) next->obstacle_poses = poses;
  const ConstrainedStep::Result& result = model->constrained_step.solve(
      free, targets.targets, surroundings, next->state.vertices, next->obstacle_poses, &solution);
  if (!solution.allFinite() || !std::isfinite(result.report.residual_n))
    throw std::runtime_error("loads or targets leave a step without a finite result");
  next->report = result.report;
  next->reactions = result.reactions;
  next->obstacle_poses.swap(poses);
}

Simulator::Simulator(const TetTopology& topology, const Material& material, const SimulatorConfig& config)
    : implementation_(std::make_unique<Implementation>(topology, material, config)) {}

Simulator::~Simulator() = default;

const TetTopology& Simulator::topology() const { return implementation_->model->topology; }

bool Simulator::placed() const { return implementation_->body.placed; }

void Simulator::step(const TargetSet& given, Nanoseconds stamp, const Surroundings& surroundings) {
  Implementation& s = *implementation_;
  TargetSet storage;
  const TargetSet& targets = s.upToDate(given, &storage);
  s.requireUsable(targets, surroundings);
  Body& next = s.next;
  next = s.body;
  if (targets.reset) s.place(targets.body_pose, stamp, &next);
  s.advance(targets, stamp, surroundings, &next);
  if (s.config.simulate && stamp > s.body.stamp)
    s.estimateLoads(targets, 1e-9 * static_cast<double>(stamp - s.body.stamp), &next);
  s.model->confidence.find(targets.targets, &next.state.confidence);
  if (!targets.targets.empty()) next.state.observed = stamp;
  std::swap(s.body, next);
}

void Simulator::stepUnobserved(const TargetSet& given, Nanoseconds stamp, const Surroundings& surroundings) {
  constexpr double kHalfLife = 0.5;  // [s]
  Implementation& s = *implementation_;
  TargetSet storage;
  const TargetSet& earlier = s.upToDate(given, &storage);
  s.requireUsable(earlier, surroundings);
  if (!s.body.placed) throw std::invalid_argument("the body has no place yet");
  Body& next = s.next;
  next = s.body;
  s.advance(earlier, stamp, surroundings, &next);
  const double elapsed_s = 1e-9 * static_cast<double>(next.stamp - s.body.stamp);
  const auto fade = static_cast<float>(std::pow(0.5, elapsed_s / kHalfLife));
  for (float& confidence : next.state.confidence) confidence *= fade;
  std::swap(s.body, next);
}

void Simulator::settle(const TargetSet& given, const Surroundings& surroundings) {
  Implementation& s = *implementation_;
  TargetSet storage;
  const TargetSet& targets = s.upToDate(given, &storage);
  s.requireUsable(targets, surroundings);
  Body& next = s.next;
  next = s.body;
  s.settle(targets, surroundings, &next);
  s.model->confidence.find(targets.targets, &next.state.confidence);
  std::swap(s.body, next);
}

void Simulator::setVertices(const Points& vertices) {
  Body& body = implementation_->body;
  if (!body.placed) throw std::invalid_argument("the body has no place yet");
  if (vertices.rows() != body.state.vertices.rows() || !vertices.allFinite()) {
    throw std::invalid_argument(fmt::format("{} vertices, or not finite ones, for a body of {}",
                                            vertices.rows(), body.state.vertices.rows()));
  }
  body.state.vertices = vertices;
  body.velocity.setZero();
  body.obstacle_poses.clear();
}

void Simulator::reset() {
  Implementation& s = *implementation_;
  s.body = {};
  if (s.model->topology.revision != s.uncut.revision) {
    s.volume = EditedVolume(s.uncut);
    s.adopt(s.uncut);
  }
  s.body.state.revision = s.uncut.revision;
}

bool Simulator::apply(const Cut& cut, std::string* reason) {
  Implementation& s = *implementation_;
  EditedVolume edited = s.volume;
  const std::optional<TetEdit> edit = edited.apply(cut, reason);
  if (!edit) return false;
  Body next = s.body;
  if (next.placed) carryOver(*edit, s.model->topology.tets, &next);
  s.adopt(edit->topology);
  if (next.placed) s.model->load_estimate.balance(next.state.vertices, &next.loads);
  next.state.revision = edit->topology.revision;
  s.volume = std::move(edited);
  s.body = std::move(next);
  return true;
}

TargetSet Simulator::broughtUpToDate(TargetSet targets) const {
  return implementation_->volume.broughtUpToDate(std::move(targets));
}

const MeshState& Simulator::state() const { return implementation_->body.state; }

const StepReport& Simulator::report() const { return implementation_->body.report; }

const Reactions& Simulator::reactions() const { return implementation_->body.reactions; }

double Simulator::elasticEnergy() const {
  const Points& x = implementation_->body.state.vertices;
  Points unused = Points::Zero(x.rows(), 3);
  return implementation_->model->solver->addElasticity(x, &unused);
}

}  // namespace softbody
