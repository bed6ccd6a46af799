#pragma once

#include <memory>
#include <string>

#include "softbody_common/cut.h"
#include "softbody_common/types.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/dynamics/simulator_config.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_sim/time_step/step_report.h"

namespace softbody {

/// The volumetric model under the soft constraints of one frame after another: implicit Euler by projective
/// dynamics (Bouaziz et al. 2014) accelerated by L-BFGS (Liu, Bouaziz, Kavan 2017), or by finite elements
/// with Newton's method.
class Simulator {
 public:
  /// @throw std::invalid_argument if topology, material or config make no body.
  Simulator(const TetTopology& topology, const Material& material, const SimulatorConfig& config);
  ~Simulator();

  const TetTopology& topology() const;

  /// False until the first TargetSet with `reset` has placed the body.
  bool placed() const;

  /// Advances to `stamp` under the targets. Before anything else a TargetSet with `reset` places the rest
  /// shape at body_pose at rest. A stamp not after the last one advances by no time, only the targets act.
  /// Leaves the state as it was where it throws. Allocates nothing, projective dynamics that is, but where
  /// there are more targets or contacts than ever before, and in the first steps after a change of topology.
  /// @throw std::invalid_argument if the revision is neither the topology's nor one of the last few, a target
  /// names a tet beyond it, a number is not finite, a barycentric coordinate is beyond 100, a weight is not
  /// above 0 or beyond largestStiffness, or the body has not been placed; std::runtime_error if loads or
  /// targets leave a system that cannot be solved or has no finite solution.
  void step(const TargetSet& targets, Nanoseconds stamp, const Surroundings& surroundings = {});

  /// As step, without a new observation: targets seen earlier still hold (their `reset` does not), `observed`
  /// stays, and confidence halves with every half second.
  void stepUnobserved(const TargetSet& earlier, Nanoseconds stamp, const Surroundings& surroundings = {});

  /// Static equilibrium under targets, gravity and surroundings, which have to hold the body: a step that
  /// takes forever. Stamp and velocity: as before, and none.
  /// @throw as step does.
  void settle(const TargetSet& targets, const Surroundings& surroundings = {});

  /// Puts a placed body's vertices somewhere, at rest, whatever shape that is. @param vertices #V by 3 [m].
  /// @throw std::invalid_argument if the body has not been placed, or not that many finite vertices are
  /// given.
  void setVertices(const Points& vertices);

  /// Edits the topology. Positions, velocities and confidences go over without a jump; targets of the few
  /// revisions before are still understood. Nothing changes where it returns false.
  /// A patch that crosses no tet edge changes the revision only.
  /// @param reason why the cut is not made: it is not for the next revision, or there is nothing to undo or
  /// redo.
  /// @throw std::invalid_argument if the patch is not finite or names a vertex that it does not have.
  bool apply(const Cut& cut, std::string* reason);
  /// Targets of one of the last few revisions, for the present one; others as they are. Who keeps targets
  /// through more edits than that brings them up to date at each.
  TargetSet toCurrentRevision(TargetSet targets) const;

  /// Back to "not placed" and not cut, at the first revision.
  void reset();

  const MeshState& state() const;
  const StepReport& report() const;
  const Reactions& reactions() const;

  /// Elastic energy of the present state [J].
  double elasticEnergy() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
