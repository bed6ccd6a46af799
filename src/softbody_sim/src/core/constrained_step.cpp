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
    : topology_(&topology), contact_(std::move(contact)), options_(options), solver_(solver) {}

/// What stays the same while contacts are found again.
struct ConstrainedStep::Problem {
  const std::vector<Target>& targets;
  const Surroundings& surroundings;
  const Points& before;
  const std::vector<Eigen::Isometry3d>& before_poses;
  StepPotential potential;  ///< with the springs of the latest contacts
};

ConstrainedStep::Result ConstrainedStep::solve(StepPotential free, const std::vector<Target>& targets,
                                               const Surroundings& surroundings, const Points& before,
                                               const std::vector<Eigen::Isometry3d>& before_poses,
                                               Points* x) {
  if (surroundings.loads.size() > 0) free.loads += surroundings.loads;
  Problem problem{targets, surroundings, before, before_poses, free};
  hold(surroundings.pins, options_.pin_stiffness, &problem.potential);
  chooseStart(&problem, x);
  Result result;
  const std::vector<Contact> contacts = iterate(&problem, x, &result.report);
  result.reactions.obstacles = contact_.wrenches(contacts, *x, surroundings.obstacles);
  free.targets = std::move(problem.potential.targets);
  result.reactions.pins = pinWrenches(free, surroundings.pins, *x);
  return result;
}

/// A body that hangs or lies is nearer to its end where it was than where the loads alone take it.
void ConstrainedStep::chooseStart(Problem* problem, Points* x) {
  const Surroundings& surroundings = problem->surroundings;
  if (surroundings.pins.empty() && surroundings.obstacles.empty()) return;
  Points still = problem->before;
  for (const Pin& pin : surroundings.pins) still.row(pin.vertex) = x->row(pin.vertex) = pin.position;
  if (energyAt(still, problem) < energyAt(*x, problem)) x->swap(still);
}

double ConstrainedStep::energyAt(const Points& x, Problem* problem) {
  setSprings(contactsAt(x, *problem), problem);
  Points unused(x.rows(), 3);
  return problem->potential.evaluate(x, &unused) + solver_->addElasticity(x, &unused);
}

/// @return the contacts under which the result was found.
std::vector<Contact> ConstrainedStep::iterate(Problem* problem, Points* x, StepReport* report) {
  constexpr int kMaxRounds = 5;
  std::vector<Contact> contacts = contactsAt(*x, *problem);
  for (int round = 1;; ++round) {
    setSprings(contacts, problem);
    const int iterations = report->iterations;
    *report = solver_->minimize(problem->potential, x);
    report->iterations += iterations;
    if (problem->surroundings.obstacles.empty()) return contacts;
    std::vector<Contact> now = updated(contacts, contactsAt(*x, *problem));
    if (contact_.difference(contacts, now, *x) < options_.contact_tolerance_m) return contacts;
    if (round == kMaxRounds) {
      report->converged = false;
      return contacts;
    }
    contacts = std::move(now);
  }
}

std::vector<Contact> ConstrainedStep::contactsAt(const Points& x, const Problem& problem) {
  return contact_.find(problem.before, x, problem.surroundings.obstacles, problem.before_poses);
}

void ConstrainedStep::setSprings(const std::vector<Contact>& contacts, Problem* problem) const {
  problem->potential.targets.set(problem->targets, topology_->tets, options_.target_stiffness);
  contact_.addSprings(contacts, &problem->potential.targets);
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
