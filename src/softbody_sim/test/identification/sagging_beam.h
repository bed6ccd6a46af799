#pragma once

#include <random>
#include <vector>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/identification/material_estimate.h"

namespace softbody::testing {

/// A beam along x, clamped at its lower end, and what is seen of it.
struct SaggingBeam {
  explicit SaggingBeam(const Material& truth_in = {4e4, 0.3, 300.0, 0.1}) : truth(truth_in) {
    problem.topology = boxTopology({6, 2, 2}, {0.12, 0.03, 0.03});
    problem.prior = truth;
    problem.prior.youngs_modulus_pa = 1e5;
    problem.simulator.gravity = {0.0, 0.0, -9.81};
    problem.mass_std = 0.0;
    for (int v = 0; v < rest().rows(); ++v) {
      if (rest()(v, 0) < 1e-9) clamp.pins.push_back({v, rest().row(v)});
      if (rest()(v, 0) > 0.12 - 1e-9) end.push_back(v);
    }
  }

  const Points& rest() const { return problem.topology.rest_vertices; }

  /// Surroundings that also hold the end, shifted [m].
  Surroundings pulled(const Eigen::Vector3d& shift) const {
    Surroundings surroundings = clamp;
    for (const int v : end) surroundings.pins.push_back({v, rest().row(v).transpose() + shift});
    return surroundings;
  }

  /// Adds what the true body does in surroundings: all vertices of its surface, and if it is pulled, the
  /// force at the end. @return its vertices.
  Points observe(const Surroundings& surroundings, double noise_m = 0.0, double force_noise_n = 0.0) {
    SimulatorConfig config = problem.simulator;
    config.solver = SolverKind::kFem;
    config.iterations = 200;
    config.tolerance = 1e-10;
    Simulator simulator(problem.topology, truth, config);
    simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
    for (int k = 0; k < 30; ++k) simulator.settle({}, surroundings);
    ShapeObservation observation;
    observation.stamp = static_cast<Nanoseconds>(problem.observations.size()) * 1000000000;
    observation.targets = noisy(vertexTargets(problem.topology, simulator.state().vertices), noise_m);
    observation.surroundings = surroundings;
    if (force_noise_n > 0.0) {
      MeasuredWrench wrench;
      wrench.vertices = end;
      wrench.force_std_n = force_noise_n;
      for (std::size_t p = 0; p < surroundings.pins.size(); ++p)
        if (surroundings.pins[p].vertex >= end.front())
          wrench.value.force += simulator.reactions().pins[p].force;
      wrench.value.force += force_noise_n * noise();
      observation.wrenches.push_back(wrench);
    }
    problem.observations.push_back(observation);
    return simulator.state().vertices;
  }

  /// Standard normal in each coordinate.
  Eigen::Vector3d noise() {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(random), normal(random), normal(random));
  }

  std::vector<Target> noisy(std::vector<Target> targets, double noise_m) {
    for (Target& target : targets) target.position += noise_m * noise();
    return targets;
  }

  Material truth;
  MaterialProblem problem;
  Surroundings clamp;
  std::vector<int> end;  ///< vertices of the free end
  std::mt19937 random{1};
};

inline const EstimatedProperty& propertyOf(const MaterialEstimate& estimate, const std::string& name) {
  for (const EstimatedProperty& property : estimate.properties)
    if (property.name == name) return property;
  throw std::out_of_range(name);
}

}  // namespace softbody::testing
