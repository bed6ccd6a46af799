#include "softbody_sim/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/fem_solver.h"
#include "core/observation_confidence.h"
#include "core/projective_dynamics.h"
#include "core/step_potential.h"
#include "core/step_solver.h"
#include "core/surface_follower.h"
#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

/// The frame interval that Material::damping refers to, and the inertia of a step that takes no time.
constexpr double kNominalTimeStep = 1.0 / 30.0;

/// Beyond it a target lies so far out of its tet that it says nothing about the tet, and its square in the
/// metric drowns the body's own stiffness.
constexpr double kLargestBarycentric = 100.0;

/// A quarter of each tet's mass to each of its vertices [kg].
Eigen::VectorXd lumpedMasses(const TetTopology& topology, double density_kg_m3) {
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(topology.rest_vertices.rows());
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k) masses[topology.tets(t, k)] += 0.25 * density_kg_m3 * volumes[t];
  }
  for (Eigen::Index v = 0; v < masses.size(); ++v) {
    if (!(masses[v] > 0.0))
      throw std::invalid_argument(fmt::format("vertex {} has no mass: no tet uses it", v));
  }
  return masses;
}

double densityOf(const TetTopology& topology, const Material& material, const SimulatorConfig& config) {
  if (!config.normalized_mass) return material.density_kg_m3;
  return 1.0 / tetVolumes(topology.rest_vertices, topology.tets).sum();
}

std::unique_ptr<StepSolver> makeSolver(const TetTopology& topology, const Material& material,
                                       const SimulatorConfig& config, double edge_length) {
  requireConsistent(config);
  const Lame lame = lameParameters(material.youngs_modulus_pa, material.poisson_ratio);
  const double tolerance_m = config.tolerance * edge_length;
  if (config.solver == SolverKind::kFem) {
    return std::make_unique<FemSolver>(topology, config.elasticity, lame,
                                       FemSolver::Options{config.iterations, tolerance_m});
  }
  ProjectiveDynamicsOptions options;
  options.minimizer.max_iterations = config.iterations;
  options.minimizer.tolerance_m = tolerance_m;
  options.minimizer.history = config.lbfgs_history;
  options.single_precision = config.single_precision;
  options.simd = simdFromName(config.simd);
  return std::make_unique<ProjectiveDynamics>(topology, lame, options);
}

void requireUsable(const Target& target, std::size_t index, Eigen::Index tet_count) {
  if (target.place.tet < 0 || target.place.tet >= tet_count) {
    throw std::invalid_argument(
        fmt::format("targets[{}] names tet {} of {}", index, target.place.tet, tet_count));
  }
  const bool finite = target.place.barycentric.allFinite() && target.position.allFinite() &&
                      target.normal.allFinite() && std::isfinite(target.weight);
  if (!finite || target.weight <= 0.0) {
    throw std::invalid_argument(fmt::format("targets[{}]: not finite, or its weight is not above 0", index));
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
  MeshState state;
  StepReport report;
};

}  // namespace

struct Simulator::Implementation {
  Implementation(const TetTopology& topology_in, const Material& material_in,
                 const SimulatorConfig& config_in);

  void requireUsable(const TargetSet& targets) const;
  void place(const Eigen::Isometry3d& pose, Nanoseconds stamp, Body* next) const;
  void advance(const TargetSet& targets, Nanoseconds stamp, Body* next);
  void simulate(const TargetSet& targets, double elapsed_s, Body* next);

  const TetTopology topology;
  const Material material;
  const SimulatorConfig config;
  const double edge_length;  ///< mean [m]

  const Eigen::VectorXd masses;  ///< lumped [kg]
  const std::unique_ptr<StepSolver> solver;
  StepPotential potential;
  ObservationConfidence confidence;

  Body body;
};

Simulator::Implementation::Implementation(const TetTopology& topology_in, const Material& material_in,
                                          const SimulatorConfig& config_in)
    : topology(topology_in),
      material(material_in),
      config(config_in),
      edge_length(meanEdgeLength(topology.rest_vertices, topology.tets)),
      masses(lumpedMasses(topology, densityOf(topology, material, config))),
      solver(makeSolver(topology, material, config, edge_length)),
      confidence(topology.rest_vertices, topology.tets) {
  body.state.revision = topology.revision;
}

void Simulator::Implementation::requireUsable(const TargetSet& targets) const {
  if (targets.revision != topology.revision) {
    throw std::invalid_argument(fmt::format("targets are for revision {} of the volume, which is at {}",
                                            targets.revision, topology.revision));
  }
  if (!body.placed && !targets.reset) {
    throw std::invalid_argument("the body has no place yet: waiting for targets with reset and a body_pose");
  }
  if (targets.reset && !targets.body_pose.matrix().allFinite())
    throw std::invalid_argument("body_pose is not finite");
  for (std::size_t i = 0; i < targets.targets.size(); ++i) {
    softbody::requireUsable(targets.targets[i], i, topology.tets.rows());
  }
}

void Simulator::Implementation::place(const Eigen::Isometry3d& pose, Nanoseconds stamp, Body* next) const {
  next->state.vertices = transformed(topology.rest_vertices, pose);
  next->velocity = Points::Zero(next->state.vertices.rows(), 3);
  next->stamp = stamp;
  next->placed = true;
}

void Simulator::Implementation::advance(const TargetSet& targets, Nanoseconds stamp, Body* next) {
  if (targets.reset) place(targets.body_pose, stamp, next);
  if (config.simulate) {
    simulate(targets, std::max(0.0, 1e-9 * static_cast<double>(stamp - next->stamp)), next);
  } else {
    followTargets(targets.targets, topology, &next->state.vertices);
    next->report = {0, true};
  }
  next->stamp = std::max(next->stamp, stamp);
  next->state.confidence = confidence.of(targets.targets);
  if (!targets.targets.empty()) next->state.observed = stamp;
}

void Simulator::Implementation::simulate(const TargetSet& targets, double elapsed_s, Body* next) {
  const double h = elapsed_s > 0.0 ? std::min(elapsed_s, config.max_time_step_s) : kNominalTimeStep;
  potential.prediction = next->state.vertices;
  potential.loads = Points::Zero(masses.size(), 3);
  if (elapsed_s > 0.0) {
    next->velocity *= std::pow(1.0 - material.damping, h / kNominalTimeStep);
    potential.prediction += h * next->velocity;
    potential.loads = masses * config.gravity.transpose();
  }
  potential.inertia = masses / (h * h);
  potential.targets.set(targets.targets, topology.tets,
                        config.target_stiffness * material.youngs_modulus_pa * edge_length);

  // Where the loads alone take the vertices.
  Points x = potential.prediction + potential.inertia.cwiseInverse().asDiagonal() * potential.loads;
  next->report = solver->minimize(potential, &x);
  // Over a gap that is simulated as a shorter step the body still took the whole gap for its way.
  if (elapsed_s > 0.0) next->velocity = (x - next->state.vertices) / elapsed_s;
  next->state.vertices.swap(x);
}

Simulator::Simulator(const TetTopology& topology, const Material& material, const SimulatorConfig& config)
    : implementation_(std::make_unique<Implementation>(topology, material, config)) {}

Simulator::~Simulator() = default;

const TetTopology& Simulator::topology() const { return implementation_->topology; }

bool Simulator::placed() const { return implementation_->body.placed; }

void Simulator::step(const TargetSet& targets, Nanoseconds stamp) {
  Implementation& s = *implementation_;
  s.requireUsable(targets);
  Body next = s.body;
  s.advance(targets, stamp, &next);
  s.body = std::move(next);
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
}

void Simulator::reset() {
  Implementation& s = *implementation_;
  s.body = {};
  s.body.state.revision = s.topology.revision;
}

const MeshState& Simulator::state() const { return implementation_->body.state; }

const StepReport& Simulator::report() const { return implementation_->body.report; }

}  // namespace softbody
