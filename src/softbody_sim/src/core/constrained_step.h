#pragma once

#include <vector>

#include "core/contact_model.h"
#include "core/step_solver.h"
#include "softbody_sim/surroundings.h"

namespace softbody {

/// @throw std::invalid_argument unless vertices exist and numbers are finite.
void requireUsable(const Surroundings& surroundings, Eigen::Index vertex_count);

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

  /// @param free the step without targets and surroundings; @param before vertices at its start;
  /// @param before_poses of the obstacles then; @param x start, then result.
  Result solve(StepPotential free, const std::vector<Target>& targets, const Surroundings& surroundings,
               const Points& before, const std::vector<Eigen::Isometry3d>& before_poses, Points* x);

 private:
  struct Problem;

  void chooseStart(Problem* problem, Points* x);
  double energyAt(const Points& x, Problem* problem);
  std::vector<Contact> iterate(Problem* problem, Points* x, StepReport* report);
  std::vector<Contact> contactsAt(const Points& x, const Problem& problem);
  void setSprings(const std::vector<Contact>& contacts, Problem* problem) const;
  std::vector<Wrench> pinWrenches(const StepPotential& free, const std::vector<Pin>& pins,
                                  const Points& x) const;

  const TetTopology* topology_;
  ContactModel contact_;
  Options options_;
  StepSolver* solver_;
};

}  // namespace softbody
