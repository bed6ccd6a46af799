#pragma once

#include <vector>

#include "constraints/contact_forces.h"
#include "softbody_sim/constraints/surroundings.h"
#include "time_step/rigid_descent.h"
#include "time_step/step_solver.h"

namespace softbody {

/// A step with pins, contacts and loads. Detects contacts and solves in turns, until the contacts no longer
/// change.
class ConstrainedStep {
 public:
  struct Options {
    double target_stiffness = 0.0;  ///< of a target of weight 1 [N/m]
    double pin_stiffness = 0.0;     ///< the largest: far above all other stiffnesses [N/m]
    double tolerance = 0.0;         ///< as MinimizerOptions
    double contact_tolerance_m = 0.0;
    double penetration_tolerance_m = 0.0;
    double noticeable_move_m = 0.0;  ///< of a free body in a step; gives the unit of unbalanced forces
  };
  struct Result {
    StepReport report;
    Reactions reactions;
    std::vector<Contact> contacts;  ///< for the ContactState of the next step
  };

  /// @param topology, solver outlive this.
  ConstrainedStep(const TetTopology& topology, ContactForces contact, const Options& options,
                  StepSolver* solver);

  /// Forgets what a simulation from other shapes has left. @param x first shape of the next one [m].
  void restart(const Points& x);

  /// Allocates only when the number of targets or contacts exceeds all earlier ones.
  /// @param free the step without targets and surroundings; @param before vertices at its start [m];
  /// @param state of the contacts then; @param x start, then result [m]. @return valid until the next call.
  const Result& solve(const IncrementalPotential& free, const std::vector<Target>& targets,
                      const Surroundings& surroundings, const Points& before, const ContactState& state,
                      Points* x);

  /// [N/m]
  double stiffnessOf(const Pin& pin) const;
  /// Replaces all springs by those of contacts.
  void setContactSprings(const std::vector<Contact>& contacts, TargetEnergy* springs);
  /// @param state of the contacts at the vertices x [m].
  std::vector<PointForce> contactForces(const ContactState& state, const Points& x) {
    return contact_.pointForces(state, x);
  }

 private:
  struct Problem;

  void setPotential(const Problem& problem);
  void addPins(const std::vector<Pin>& pins);
  void chooseStart(const Problem& problem, Points* x);
  double energyAt(const Points& x, const Problem& problem);
  void iterate(const Problem& problem, Points* x);
  void minimize(const Problem& problem, Points* x);
  bool contactsStay(const Problem& problem, const Points& x);
  void findContacts(const Points& x, const Problem& problem, std::vector<Contact>* contacts);
  void setSprings(const std::vector<Target>& targets);
  void findPinForces(const Problem& problem, const Points& x);

  const TetTopology* topology_;
  ContactForces contact_;
  Options options_;
  StepSolver* solver_;
  RigidDescent rigid_descent_;
  IncrementalPotential potential_;  ///< with pins and the springs of contacts_
  const std::vector<Target> no_targets_;
  std::vector<Contact> contacts_;  ///< that the result was computed with
  std::vector<Contact> balanced_;  ///< those, with the forces at the result
  std::vector<Contact> found_;     ///< at the result
  Points still_, moved_, gradient_;
  Result result_;
};

}  // namespace softbody
