#include "dynamics/body_model.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "softbody_common/tet_geometry.h"
#include "time_step/fem_solver.h"
#include "time_step/projective_dynamics.h"

namespace softbody {
namespace {

/// A quarter of each tet's mass to each of its vertices [kg].
Eigen::VectorXd lumpedMasses(const TetTopology& topology, double density_kg_m3) {
  if (topology.tets.rows() == 0) throw std::invalid_argument("the topology has no tets");
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(topology.rest_vertices.rows());
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k) masses[topology.tets(t, k)] += 0.25 * density_kg_m3 * volumes[t];
  }
  for (Eigen::Index v = 0; v < masses.size(); ++v) {
    if (!(masses[v] > 0.0))
      throw std::invalid_argument(
          fmt::format("vertex {} has no mass: it belongs to no tet; remove it from the mesh", v));
  }
  return masses;
}

double densityOf(const TetTopology& topology, const Material& material, const SimulatorConfig& config) {
  if (!config.normalized_mass) return material.density_kg_m3;
  return 1.0 / tetVolumes(topology.rest_vertices, topology.tets).sum();
}

std::unique_ptr<StepSolver> makeSolver(const TetTopology& topology, const Material& material,
                                       const SimulatorConfig& config) {
  requireConsistent(config);
  const Lame lame = lameParameters(material.youngs_modulus_pa, material.poisson_ratio);
  const Smoothing smoothing(config.strain_smoothing,
                            config.volume_smoothing.value_or(volumeSmoothing(material.poisson_ratio)));
  if (config.solver == SolverKind::kFem) {
    return std::make_unique<FemSolver>(topology, config.elasticity, lame, smoothing,
                                       FemSolver::Options{config.iterations, config.tolerance});
  }
  ProjectiveDynamicsOptions options;
  options.minimizer.max_iterations = config.iterations;
  options.minimizer.tolerance = config.tolerance;
  options.minimizer.history = config.lbfgs_history;
  options.single_precision = config.single_precision;
  options.simd = simdFromName(config.simd);
  options.smoothing = smoothing;
  return std::make_unique<ProjectiveDynamics>(topology, lame, options);
}

/// Largest stiffness of a pin relative to the body. Larger values would lose too many digits to rounding.
constexpr double kPinStiffness = 1e5;

/// Penetration that needs no further round [mean edge lengths]. The next step starts with the lift that ends
/// it.
constexpr double kPenetration = 5e-3;

/// A force that moves a free body by less in a step is too small to be balanced [mean edge lengths].
constexpr double kNoticeableMove = 0.01;

/// Distance up to which a point takes part in contact, and depth to which pieces that start in each other
/// push themselves apart in a step [mean edge lengths].
constexpr double kReach = 0.1;

/// Depth in another piece from which its nearest surface may be that of the far side [mean edge lengths].
constexpr double kDeepest = 1.0;

ConstrainedStep makeStep(const TetTopology& topology, const Material& material, const SimulatorConfig& config,
                         double edge_length, double target_stiffness, StepSolver* solver) {
  const double E = material.youngs_modulus_pa;
  ContactForces contact(topology, config.contact_spacing * edge_length,
                        config.contact_stiffness * E / edge_length, kReach * edge_length,
                        edge_length / config.contact_stiffness);
  if (config.self_contact) {
    contact.addSelfContact(
        {kReach * edge_length, kReach * edge_length, kDeepest * edge_length, config.self_friction});
  }
  return {topology,
          std::move(contact),
          {target_stiffness, config.target_accuracy_m, kPinStiffness * E * edge_length, 1e-3 * edge_length,
           kPenetration * edge_length, kNoticeableMove * edge_length},
          solver};
}

}  // namespace

BodyModel::BodyModel(TetTopology topology_in, const Material& material, const SimulatorConfig& config,
                     double edge_length)
    : topology(std::move(topology_in)),
      masses(lumpedMasses(topology, densityOf(topology, material, config))),
      target_stiffness(config.target_stiffness * material.youngs_modulus_pa * edge_length),
      solver(makeSolver(topology, material, config)),
      constrained_step(makeStep(topology, material, config, edge_length, target_stiffness, solver.get())),
      vertex_confidence(topology.rest_vertices, topology.tets),
      vertex_deviation(topology),
      load_estimator(topology, masses, config.load_fade_s),
      occluded_piece_damping(topology) {}

}  // namespace softbody
