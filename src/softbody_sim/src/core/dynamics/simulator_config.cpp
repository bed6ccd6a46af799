#include "softbody_sim/dynamics/simulator_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "softbody_common/target_limits.h"

namespace softbody {

double largestStiffness(const SimulatorConfig& config) {
  // Then three digits of the body's own stiffness remain in single precision, nine in double precision.
  return config.single_precision ? 1e4 : 1e7;
}

void requireConsistent(const SimulatorConfig& config) {
  const double largest = largestStiffness(config) / kLargestTargetWeight;
  if (config.target_stiffness > largest) {
    throw std::invalid_argument(fmt::format(
        "target_stiffness is {}; allowed in {} precision: up to {}, because targets have weights up to {}",
        config.target_stiffness, config.single_precision ? "single" : "double", largest,
        kLargestTargetWeight));
  }
  if (config.solver == SolverKind::kProjectiveDynamics && config.elasticity != Elasticity::kCorotated) {
    throw std::invalid_argument(
        fmt::format("elasticity is '{}' with solver 'pd'; it needs solver 'fem'", nameOf(config.elasticity)));
  }
  if (config.elasticity == Elasticity::kSprings &&
      (config.strain_smoothing > 0.0 || config.volume_smoothing != 0.0)) {
    throw std::invalid_argument(
        "elasticity is 'springs', whose strains cannot be smoothed; set strain_smoothing and "
        "volume_smoothing to 0");
  }
}

SimulatorConfig configForPrediction(SimulatorConfig config) {
  constexpr int kIterations = 200;  // far more than a step needs
  if (config.solver == SolverKind::kFem) return config;
  config.solver = SolverKind::kPrediction;
  // Only with a history there is a line search, and this metric does not bound the curvature as that of
  // projective dynamics does.
  config.lbfgs_history = std::max(config.lbfgs_history, 1);
  config.iterations = std::max(config.iterations, kIterations);
  return config;
}

SimulatorConfig readSimulatorConfig(Parameters& parameters) {
  SimulatorConfig config;
  if (parameters.choice("solver", "pd", {"pd", "fem"}) == "fem") config.solver = SolverKind::kFem;
  config.elasticity =
      elasticityFromName(parameters.choice("elasticity", nameOf(config.elasticity), elasticityNames()));
  config.simulate = parameters.flag("simulate", config.simulate);
  config.iterations = parameters.integer("iterations", config.iterations, 1, 1000);
  config.tolerance = parameters.number("tolerance", config.tolerance, 0.0, 1.0);
  config.normalized_mass = parameters.flag("normalized_mass", config.normalized_mass);
  config.lbfgs_history = parameters.integer("lbfgs_history", config.lbfgs_history, 0, 5);
  config.strain_smoothing = parameters.number("strain_smoothing", config.strain_smoothing, 0.0, 0.95);
  config.volume_smoothing = parameters.optionalNumber("volume_smoothing", 0.0, 1.0);
  config.single_precision = parameters.flag("single_precision", config.single_precision);
  config.simd = parameters.choice("simd", config.simd, {"auto", "sse4", "avx2", "avx512"});
  config.target_stiffness = parameters.number("target_stiffness", config.target_stiffness, 1e-6, 1e6);
  config.target_accuracy_m = parameters.number("target_accuracy_m", config.target_accuracy_m, 1e-6, 1.0);
  config.load_fade_s = parameters.number("load_fade_s", config.load_fade_s, 0.0, 1e3);
  config.memory_s = parameters.number("memory_s", config.memory_s, 0.0, 1e3);
  config.contact_stiffness = parameters.number("contact_stiffness", config.contact_stiffness, 1e-3, 1e4);
  config.self_contact = parameters.flag("self_contact", config.self_contact);
  config.self_friction = parameters.number("self_friction", config.self_friction, 0.0, 10.0);
  config.contact_spacing = parameters.number("contact_spacing", config.contact_spacing, 0.1, 100.0);
  config.max_time_step_s = parameters.number("max_time_step_s", config.max_time_step_s, 1e-3, 10.0);
  config.undo_memory_mb = parameters.number("undo_memory_mb", config.undo_memory_mb, 0.0, 1e5);
  const std::vector<double> gravity = parameters.numbers("gravity_m_s2", {0.0, 0.0, 0.0});
  config.gravity = {gravity[0], gravity[1], gravity[2]};
  requireConsistent(config);
  return config;
}

}  // namespace softbody
