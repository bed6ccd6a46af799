#include "softbody_sim/dynamics/simulator_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

using Config = SimulatorConfig;
using Table = ParameterTable<Config>;

void addSolver(Table* table) {
  table->choice<SolverKind>("solver", &Config::solver,
                            {{"pd", SolverKind::kProjectiveDynamics}, {"fem", SolverKind::kFem}},
                            "pd is fast; fem is slower and more accurate");
  std::vector<std::pair<std::string, Elasticity>> elasticities;
  for (const std::string& name : elasticityNames()) elasticities.emplace_back(name, elasticityFromName(name));
  table->choice<Elasticity>("elasticity", &Config::elasticity, elasticities,
                            "neo_hookean and springs need fem; springs also need both smoothings 0");
  table->number(
      "iterations", &Config::iterations, {1, 1000}, "",
      "largest number of iterations in a step; more for a nearly incompressible body, fewer for a slow "
      "computer",
      Change::kLive);
  table->number(
      "strain_smoothing", &Config::strain_smoothing, {0.0, 0.95}, "share",
      "share of the shear energy with averaged strains; for comparisons: with less, bodies bend too little");
  table->number("volume_smoothing", &Config::volume_smoothing, {0.0, 1.0}, "share", "from Poisson's ratio",
                "share of the volume energy with averaged strains; for comparisons, too");
  table->number(
      "lbfgs_history", &Config::lbfgs_history, {0, 5}, "",
      "number of earlier iterations that L-BFGS uses; 0: plain projective dynamics, for comparisons");
  table->flag("single_precision", &Config::single_precision,
              "faster; positions are then precise to about 0.1 µm");
}

void addEstimate(Table* table) {
  table->number(
      "target_stiffness", &Config::target_stiffness, {1e-6, 1e7 / kLargestTargetWeight}, "E × edge",
      "stiffness of a target of weight 1; less for a noisy camera; with single_precision at most 100",
      Change::kLive);
  table->number("load_fade_s", &Config::load_fade_s, {0.0, 1e3}, "s",
                "time in which what is known of unknown loads falls to 1/e; 0: neither loads nor standard "
                "deviations are estimated",
                Change::kLive);
  table->number(
      "memory_s", &Config::memory_s, {0.0, 1e3}, "s",
      "time over which measurements of a body at rest are averaged; 0: each frame is taken as it is",
      Change::kLive);
  table->numbers("gravity_m_s2", &Config::gravity, "m/s²", "three numbers",
                 "gravity in the frame of the targets; zero if the rest shape already includes gravity");
}

void addContact(Table* table) {
  table->flag("self_contact", &Config::self_contact,
              "parts of the body cannot enter each other, in steps without targets");
  table->number("self_friction", &Config::self_friction, {0.0, 10.0}, "",
                "coefficient of Coulomb friction between these parts", Change::kLive);
}

Table makeSimulatorTable() {
  Table table;
  table.group("simulator");
  addSolver(&table);
  addEstimate(&table);
  addContact(&table);
  table.check(requireConsistent);
  return table;
}

}  // namespace

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

const ParameterTable<SimulatorConfig>& simulatorParameters() {
  static const ParameterTable<SimulatorConfig> table = makeSimulatorTable();
  return table;
}

}  // namespace softbody
