#include "core/constrained_step.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

/// A held vertex goes where its pin is, as if it were far too heavy to go elsewhere.
void hold(const std::vector<Pin>& pins, double stiffness, StepPotential* potential) {
  for (const Pin& pin : pins) {
    potential->inertia[pin.vertex] = stiffness;
    potential->prediction.row(pin.vertex) = pin.position;
    potential->loads.row(pin.vertex).setZero();
  }
}

}  // namespace

void requireUsable(const Surroundings& surroundings, Eigen::Index vertex_count) {
  for (const Pin& pin : surroundings.pins) {
    if (pin.vertex < 0 || pin.vertex >= vertex_count || !pin.position.allFinite()) {
      throw std::invalid_argument(
          fmt::format("a pin holds vertex {} of {}, or holds it nowhere", pin.vertex, vertex_count));
    }
  }
  for (const Obstacle& obstacle : surroundings.obstacles) {
    if (!obstacle.pose.matrix().allFinite()) throw std::invalid_argument("an obstacle's pose is not finite");
  }
  const Points& loads = surroundings.loads;
  if (loads.size() > 0 && (loads.rows() != vertex_count || !loads.allFinite())) {
    throw std::invalid_argument(
        fmt::format("{} loads, or not finite ones, for {} vertices", loads.rows(), vertex_count));
  }
}

ConstrainedStep::ConstrainedStep(const TetTopology& topology, ContactModel contact, const Options& options,
                                 StepSolver* solver)
    : tets_(topology.tets), contact_(std::move(contact)), options_(options), solver_(solver) {}

ConstrainedStep::Result ConstrainedStep::solve(StepPotential free, const std::vector<Target>& targets,
                                               const Surroundings& surroundings, const Points& before,
                                               const std::vector<Eigen::Isometry3d>& before_poses,
                                               Points* x) const {
  constexpr int kMaxRounds = 5;
  if (surroundings.loads.size() > 0) free.loads += surroundings.loads;
  StepPotential potential = free;
  hold(surroundings.pins, options_.pin_stiffness, &potential);
  for (const Pin& pin : surroundings.pins) x->row(pin.vertex) = pin.position;

  Result result;
  std::vector<Contact> contacts = contact_.find(before, *x, surroundings.obstacles, before_poses);
  for (int round = 0; round < kMaxRounds; ++round) {
    potential.targets.set(targets, tets_, options_.target_stiffness);
    contact_.addSprings(contacts, &potential.targets);
    const int iterations = result.report.iterations;
    result.report = solver_->minimize(potential, x);
    result.report.iterations += iterations;
    if (surroundings.obstacles.empty()) break;
    std::vector<Contact> now = contact_.find(before, *x, surroundings.obstacles, before_poses);
    if (contact_.difference(contacts, now, *x) < options_.contact_tolerance_m) break;
    result.report.converged = false;
    if (round + 1 < kMaxRounds) contacts = std::move(now);
  }
  result.reactions.obstacles = contact_.wrenches(contacts, *x, surroundings.obstacles);
  free.targets = std::move(potential.targets);
  result.reactions.pins = pinWrenches(free, surroundings.pins, *x);
  return result;
}

/// A held vertex would follow the rest of its forces; the pin takes them up.
std::vector<Wrench> ConstrainedStep::pinWrenches(const StepPotential& free, const std::vector<Pin>& pins,
                                                 const Points& x) const {
  if (pins.empty()) return {};
  Points gradient(x.rows(), 3);
  free.evaluate(x, &gradient);
  solver_->addElasticity(x, &gradient);
  std::vector<Wrench> wrenches(pins.size());
  for (std::size_t k = 0; k < pins.size(); ++k) wrenches[k].force = -gradient.row(pins[k].vertex);
  return wrenches;
}

}  // namespace softbody
