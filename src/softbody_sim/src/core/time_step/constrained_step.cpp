#include "time_step/constrained_step.h"

#include <algorithm>
#include <utility>

#include "softbody_common/protocol/target_limits.h"

namespace softbody {
ConstrainedStep::ConstrainedStep(const TetTopology& topology, ContactForces contact, const Options& options,
                                 StepSolver* solver)
    : topology_(&topology),
      contact_(std::move(contact)),
      options_(options),
      solver_(solver),
      rigid_descent_(topology) {}

/// The input of solve().
struct ConstrainedStep::Problem {
  const IncrementalPotential& free;
  const std::vector<Target>& targets;
  const Surroundings& surroundings;
  const Points& before;
  const ContactState& state;
};

const ConstrainedStep::Result& ConstrainedStep::solve(const IncrementalPotential& free,
                                                      const std::vector<Target>& targets,
                                                      const Surroundings& surroundings, const Points& before,
                                                      const ContactState& state, Points* x) {
  const Problem problem{free, targets, surroundings, before, state};
  setPotential(problem);
  addPins(surroundings.pins);
  gradient_.resize(x->rows(), 3);
  // Targets show where the parts are; contact would only add their noise, and time.
  contact_.start(before, surroundings.obstacles, targets.empty());
  chooseStart(problem, x);
  iterate(problem, x);
  findPinForces(problem, *x);
  result_.contacts.reserve(contacts_.capacity());
  result_.contacts = contacts_;
  contact_.remember(*x, surroundings.obstacles, result_.report.converged, &result_.contacts);
  contact_.wrenches(result_.contacts, *x, surroundings.obstacles, &result_.reactions.obstacles);
  return result_;
}

void ConstrainedStep::restart(const Points& x) {
  contact_.restart();
  solver_->restart(x);
}

void ConstrainedStep::setPotential(const Problem& problem) {
  potential_.pinned.clear();
  potential_.inertia = problem.free.inertia;
  potential_.prediction = problem.free.prediction;
  potential_.loads = problem.free.loads;
  if (problem.surroundings.loads.size() > 0) potential_.loads += problem.surroundings.loads;
  potential_.reference_force_n =
      potential_.loads.cwiseAbs().sum() + options_.noticeable_move_m * potential_.inertia.sum();
}

/// Stiffnesses are inverse variances, in a unit that the targets give.
double ConstrainedStep::stiffnessOf(const Pin& pin) const {
  const double ratio = kTargetAccuracy_m / pin.accuracy_m;
  return std::min(options_.target_stiffness * ratio * ratio, options_.pin_stiffness);
}

/// Inertia and the spring of a pin are one quadratic term together.
void ConstrainedStep::addPins(const std::vector<Pin>& pins) {
  for (const Pin& pin : pins) {
    const double stiffness = stiffnessOf(pin);
    if (stiffness == options_.pin_stiffness) potential_.pinned.push_back(pin.vertex);
    double& inertia = potential_.inertia[pin.vertex];
    auto prediction = potential_.prediction.row(pin.vertex);
    prediction = (inertia * prediction + stiffness * pin.position.transpose()) / (inertia + stiffness);
    inertia += stiffness;
  }
}

/// For a body that hangs or lies, its earlier shape is a better start than the prediction from the loads. So
/// is that shape moved rigidly to where springs and inertia want it, for one that slides or is carried.
void ConstrainedStep::chooseStart(const Problem& problem, Points* x) {
  const Surroundings& surroundings = problem.surroundings;
  if (surroundings.pins.empty() && surroundings.obstacles.empty()) {
    findContacts(*x, problem, &contacts_);
    if (contacts_.empty()) return;
  }
  still_ = moved_ = problem.before;
  findContacts(moved_, problem, &contacts_);
  setSprings(problem.targets);
  rigid_descent_.settle(potential_, *x, &moved_);
  for (const Pin& pin : surroundings.pins) {
    if (stiffnessOf(pin) == options_.pin_stiffness)
      still_.row(pin.vertex) = moved_.row(pin.vertex) = x->row(pin.vertex) = pin.position;
  }
  double lowest = energyAt(*x, problem);
  for (Points* candidate : {&still_, &moved_}) {
    const double energy = energyAt(*candidate, problem);
    if (!(energy < lowest)) continue;
    lowest = energy;
    x->swap(*candidate);
  }
}

double ConstrainedStep::energyAt(const Points& x, const Problem& problem) {
  findContacts(x, problem, &contacts_);
  setSprings(problem.targets);
  return potential_.evaluate(x, &gradient_) + solver_->addElasticity(x, &gradient_);
}

void ConstrainedStep::iterate(const Problem& problem, Points* x) {
  const int max_rounds = problem.targets.empty() ? 10 : 5;
  StepReport& report = result_.report;
  report = {};
  findContacts(*x, problem, &contacts_);
  for (int round = 1;; ++round) {
    setSprings(problem.targets);
    if (potential_.targets.hasContact())
      rigid_descent_.settle(potential_, *x, x);
    else if (!potential_.targets.springs().empty())
      rigid_descent_.descend(potential_, *x, x);
    minimize(problem, x);
    if (contactsStay(problem, *x)) return;
    if (round == max_rounds) {
      report.converged = false;
      return;
    }
    contacts_.swap(found_);
  }
}

/// With targets, the next step corrects what is left of this one. Without, nothing would; nor after a static
/// solve, which has no inertia.
void ConstrainedStep::minimize(const Problem& problem, Points* x) {
  const bool is_static = problem.free.inertia.isZero(0.0);
  const int tries = is_static ? 50 : problem.targets.empty() ? 5 : 1;
  constexpr int kUsual = 20;  // iterations of a try
  StepReport& report = result_.report;
  for (int k = 0, spent = 0; k < tries && spent < kUsual * tries; ++k) {
    const int iterations = report.iterations;
    report = solver_->minimize(potential_, x);
    spent += report.iterations;
    report.iterations += iterations;
    if (report.converged) return;
  }
}

/// Finds the contacts at the result x of contacts_. @return whether they are those.
bool ConstrainedStep::contactsStay(const Problem& problem, const Points& x) {
  balanced_.reserve(contacts_.capacity());
  balanced_ = contacts_;
  // Of a body that leaves an obstacle, friction is soon smaller than what a balance leaves open.
  const double unnoticed_n = options_.tolerance * result_.report.external_n;
  const bool friction_changes = contact_.updateFriction(x, unnoticed_n, &balanced_);
  // Lifts are forces, and those of a shape that is not in balance are wrong.
  const double lift_change = result_.report.converged ? contact_.updateLifts(x, &balanced_) : 0.0;
  findContacts(x, problem, &found_);
  contact_.takeDepths(x, &found_);
  keepEarlierContacts(balanced_, &found_);
  const double depth_change = contact_.largestDepthChange(balanced_, found_, x);
  return !friction_changes && depth_change < options_.contact_tolerance_m &&
         lift_change < options_.penetration_tolerance_m;
}

void ConstrainedStep::findContacts(const Points& x, const Problem& problem, std::vector<Contact>* contacts) {
  contact_.find(problem.before, x, problem.surroundings.obstacles, problem.state, contacts);
}

void ConstrainedStep::setSprings(const std::vector<Target>& targets) {
  potential_.targets.set(targets, topology_->tets, options_.target_stiffness);
  contact_.addSprings(contacts_, &potential_.targets);
}

void ConstrainedStep::setContactSprings(const std::vector<Contact>& contacts, TargetEnergy* springs) {
  springs->set(no_targets_, topology_->tets, options_.target_stiffness);
  contact_.addSprings(contacts, springs);
}

/// A pin carries all forces on its vertex. Targets are measurements, not forces.
void ConstrainedStep::findPinForces(const Problem& problem, const Points& x) {
  const std::vector<Pin>& pins = problem.surroundings.pins;
  result_.reactions.pins.assign(pins.size(), Wrench());
  if (pins.empty()) return;
  setPotential(problem);  // without pins
  setSprings(no_targets_);
  potential_.evaluate(x, &gradient_);
  solver_->addElasticity(x, &gradient_);
  for (std::size_t k = 0; k < pins.size(); ++k)
    result_.reactions.pins[k].force = -gradient_.row(pins[k].vertex);
}

}  // namespace softbody
