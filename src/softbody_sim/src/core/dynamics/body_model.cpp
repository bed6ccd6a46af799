#include "dynamics/body_model.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"
#include "time_step/fem_solver.h"
#include "time_step/prediction_solver.h"
#include "time_step/projective_dynamics.h"

namespace softbody {
namespace {

/// A quarter of each tet's mass to each of its vertices [kg].
Eigen::VectorXd lumpedMasses(const TetTopology& topology, const Eigen::VectorXd& densities) {
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(topology.rest_vertices.rows());
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k) masses[topology.tets(t, k)] += 0.25 * densities[t] * volumes[t];
  }
  for (Eigen::Index v = 0; v < masses.size(); ++v) {
    if (!(masses[v] > 0.0))
      throw std::invalid_argument(
          fmt::format("vertex {} has no mass: it belongs to no tet; remove it from the mesh", v));
  }
  return masses;
}

std::unique_ptr<StepSolver> makeSolver(const TetTopology& topology, const ElasticMaterials& materials,
                                       const SimulatorConfig& config) {
  requireConsistent(config);
  if (config.solver == SolverKind::kFem) {
    return std::make_unique<FemSolver>(topology, config.elasticity, materials,
                                       FemSolver::Options{config.iterations, config.tolerance});
  }
  const MinimizerOptions minimizer{config.iterations, config.tolerance, config.lbfgs_history};
  if (config.solver == SolverKind::kPrediction)
    return std::make_unique<PredictionSolver>(topology, materials, minimizer, simdFromName(config.simd));
  ProjectiveDynamicsOptions options;
  options.minimizer = minimizer;
  options.single_precision = config.single_precision;
  options.simd = simdFromName(config.simd);
  return std::make_unique<ProjectiveDynamics>(topology, materials, options);
}

/// Largest stiffness of a pin relative to the body. Larger values would lose too many digits to rounding.
constexpr double kPinStiffness = 1e5;

/// Pressure at a depth of one mean edge length [E]. What is softer sinks in visibly, what is stiffer takes
/// more rounds of contact.
constexpr double kContactStiffness = 10.0;

/// Distance of the contact points on the surface [mean edge lengths]: the middle of an edge has one, too.
constexpr double kContactSpacing = 0.5;

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

/// Where materials differ, pins are stiff compared with the stiffest, contacts and targets with their mean.
ConstrainedStep makeStep(const TetTopology& topology, const TetMaterials& materials,
                         const SimulatorConfig& config, double edge_length, double target_stiffness,
                         StepSolver* solver) {
  ContactForces contact(topology, kContactSpacing * edge_length,
                        kContactStiffness * materials.mean_youngs_modulus_pa / edge_length,
                        kReach * edge_length, edge_length / kContactStiffness);
  if (config.self_contact) {
    contact.addSelfContact(
        {kReach * edge_length, kReach * edge_length, kDeepest * edge_length, config.self_friction});
  }
  return {topology,
          std::move(contact),
          {target_stiffness, kPinStiffness * materials.largest_youngs_modulus_pa * edge_length,
           config.tolerance, 1e-3 * edge_length, kPenetration * edge_length, kNoticeableMove * edge_length},
          solver};
}

}  // namespace

BodyModel::BodyModel(TetTopology topology_in, const Material& material, const SimulatorConfig& config,
                     double edge_length)
    : topology(std::move(topology_in)),
      materials(tetMaterials(topology, material, config.strain_smoothing, config.volume_smoothing)),
      masses(lumpedMasses(topology, materials.densities)),
      free_motion(topology, masses),
      target_stiffness(config.target_stiffness * materials.mean_youngs_modulus_pa * edge_length),
      solver(makeSolver(topology, materials.elastic, config)),
      constrained_step(makeStep(topology, materials, config, edge_length, target_stiffness, solver.get())),
      vertex_confidence(topology.rest_vertices, topology.tets),
      load_estimator(topology, materials, masses, {config.load_fade_s, target_stiffness}),
      shape_memory(topology.tets, config.memory_s),
      occluded_piece_damping(topology),
      edge_length_(edge_length) {}

bool BodyModel::hasTets(const TetTopology& other) const {
  return topology.tets.rows() == other.tets.rows() &&
         topology.rest_vertices.rows() == other.rest_vertices.rows() && topology.tets == other.tets &&
         topology.rest_vertices == other.rest_vertices;
}

ForceEstimator& BodyModel::forceEstimator(Elasticity elasticity) {
  const double scale_n = materials.mean_youngs_modulus_pa * edge_length_ * edge_length_;
  if (!force_estimator_)
    force_estimator_ =
        std::make_unique<ForceEstimator>(topology, elasticity, materials.elastic, masses, scale_n);
  return *force_estimator_;
}

}  // namespace softbody
