#pragma once

#include <vector>

#include "constraints/contact_model.h"
#include "softbody_sim/constraints/surroundings.h"
#include "time_step/step_solver.h"

namespace softbody {

/// A step under pins, contact and loads. Contacts are found again where the solution has moved on, until what
/// they say of it no longer changes.
class ConstrainedStep {
 public:
  struct Options {
    double target_stiffness = 0.0;  ///< of a target of weight 1 [N/m]
    double pin_stiffness = 0.0;     ///< far above all else [N/m]
    double contact_tolerance_m = 0.0;
  };
  struct Result {
    StepReport report;
    Reactions reactions;
  };

  /// @param topology, solver outlive this.
  ConstrainedStep(const TetTopology& topology, ContactModel contact, const Options& options,
                  StepSolver* solver);

  /// Allocates only where there are more targets or contacts than ever before.
  /// @param free the step without targets and surroundings; @param before vertices at its start;
  /// @param before_poses of the obstacles then; @param x start, then result. @return until the next call.
  const Result& solve(const IncrementalPotential& free, const std::vector<Target>& targets,
                      const Surroundings& surroundings, const Points& before,
                      const std::vector<Eigen::Isometry3d>& before_poses, Points* x);

 private:
  struct Problem;

  void setPotential(const Problem& problem);
  void chooseStart(const Problem& problem, Points* x);
  double energyAt(const Points& x, const Problem& problem);
  void iterate(const Problem& problem, Points* x);
  void findContacts(const Points& x, const Problem& problem, std::vector<Contact>* contacts);
  void setSprings(const Problem& problem);
  void findPinForces(const Problem& problem, const Points& x);

  const TetTopology* topology_;
  ContactModel contact_;
  Options options_;
  StepSolver* solver_;
  IncrementalPotential potential_;  ///< with pins held, and the springs of contacts_
  std::vector<Contact> contacts_;   ///< under which the result was found
  std::vector<Contact> found_;      ///< where the result is
  Points still_, gradient_;
  Result result_;
};

}  // namespace softbody
