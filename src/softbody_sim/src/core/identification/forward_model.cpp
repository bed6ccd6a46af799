#include "identification/forward_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

SimulatorConfig accurate(const MaterialProblem& problem) {
  SimulatorConfig config = problem.simulator;
  config.solver = SolverKind::kFem;
  config.iterations = 200;
  config.tolerance = 1e-10;
  config.load_fade_s = 0.0;  // no load is estimated: the material explains the shape
  config.memory_s = 0.0;
  return config;
}

/// Unbalanced forces over external ones, from which a shape is no equilibrium. Rounding of stiff pins and
/// contacts ends a search long before.
constexpr double kUnbalanced = 1e-4;

/// The body is still if no vertex moves by more than this share of an edge.
constexpr double kStill = 1e-7;

/// Rounding leaves forces of up to this share of E times an edge squared.
constexpr double kRounding = 1e-9;

bool dependsOnPath(const MaterialProblem& problem) {
  if (problem.moves || problem.simulator.self_contact) return true;
  for (const ShapeObservation& observation : problem.observations)
    for (const Obstacle& obstacle : observation.surroundings.obstacles)
      if (obstacle.friction > 0.0) return true;
  return false;
}

}  // namespace

ForwardModel::ForwardModel(const MaterialProblem& problem)
    : problem_(&problem),
      in_sequence_(dependsOnPath(problem)),
      edge_m_(meanEdgeLength(problem.topology.rest_vertices, problem.topology.tets)),
      simulator_(problem.topology, problem.prior, accurate(problem)) {}

Prediction ForwardModel::predict(const Material& material) {
  simulator_.setMaterial(material);
  TargetSet placing;
  placing.reset = true;
  placing.body_pose = problem_->body_pose;
  const Nanoseconds first = problem_->observations.front().stamp;
  simulator_.step(placing, first);
  simulator_.setVertices(transformed(problem_->topology.rest_vertices, problem_->body_pose));
  Prediction prediction;
  std::size_t targets = 0, wrenches = 0;
  for (const ShapeObservation& observation : problem_->observations)
    targets += observation.targets.size(), wrenches += observation.wrenches.size();
  prediction.places.resize(static_cast<Eigen::Index>(targets), 3);
  prediction.wrenches.resize(6 * static_cast<Eigen::Index>(wrenches));
  Eigen::Index target = 0, wrench = 0;
  for (std::size_t k = 0; k < problem_->observations.size(); ++k) {
    advance(k);
    const ShapeObservation& observation = problem_->observations[k];
    const Points& x = simulator_.state().vertices;
    for (const Target& measured : observation.targets)
      prediction.places.row(target++) = positionOf(measured.place, x, problem_->topology.tets).transpose();
    for (const MeasuredWrench& measured : observation.wrenches) {
      const Wrench simulated = wrenchAt(measured, observation.surroundings);
      prediction.wrenches.segment<3>(wrench) = simulated.force;
      prediction.wrenches.segment<3>(wrench + 3) = simulated.torque;
      wrench += 6;
    }
    prediction.shapes.push_back(x);
  }
  return prediction;
}

/// Brings the body to an observation.
void ForwardModel::advance(std::size_t k) {
  const ShapeObservation& observation = problem_->observations[k];
  if (problem_->moves && k > 0) {
    const Nanoseconds from = simulator_.stamp(), way = observation.stamp - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(seconds(way) / problem_->time_step_s)));
    for (int step = 1; step <= steps; ++step)
      simulator_.step({}, from + way * step / steps, observation.surroundings);
    return;
  }
  if (!in_sequence_ && k < starts_.size()) simulator_.setVertices(starts_[k]);
  settle(observation.surroundings);
  const StepReport& report = simulator_.report();
  const double rounding_n = kRounding * simulator_.material().youngs_modulus_pa * std::pow(edge_m_, 2);
  if (!(report.residual_n <= kUnbalanced * report.external_n + rounding_n)) {
    throw std::runtime_error(fmt::format(
        "observation {} has no equilibrium with Young's modulus {:.4g} Pa: {:.3g} N of {:.3g} N are "
        "not balanced",
        k + 1, simulator_.material().youngs_modulus_pa, report.residual_n, report.external_n));
  }
}

/// Contacts are found at a shape, and change it: it settles until nothing moves.
void ForwardModel::settle(const Surroundings& surroundings) {
  constexpr int kMost = 30;  // a bound: it ends when nothing moves
  for (int attempt = 0; attempt < kMost; ++attempt) {
    const Points before = simulator_.state().vertices;
    simulator_.settle({}, surroundings);
    const double move_m = (simulator_.state().vertices - before).rowwise().norm().maxCoeff();
    if (move_m < kStill * edge_m_) return;
  }
}

Wrench ForwardModel::wrenchAt(const MeasuredWrench& measured, const Surroundings& surroundings) const {
  const Reactions& reactions = simulator_.reactions();
  Wrench sum;
  const auto add = [&](const Wrench& wrench, const Eigen::Vector3d& place) {
    sum.force += wrench.force;
    sum.torque += wrench.torque + (place - measured.origin).cross(wrench.force);
  };
  if (measured.obstacle >= 0) {
    const auto obstacle = static_cast<std::size_t>(measured.obstacle);
    add(reactions.obstacles[obstacle], surroundings.obstacles[obstacle].pose.translation());
    return sum;
  }
  for (std::size_t p = 0; p < surroundings.pins.size(); ++p) {
    const Pin& pin = surroundings.pins[p];
    if (std::binary_search(measured.vertices.begin(), measured.vertices.end(), pin.vertex))
      add(reactions.pins[p], pin.position);
  }
  return sum;
}

}  // namespace softbody
