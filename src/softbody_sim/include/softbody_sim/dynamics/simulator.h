#pragma once

#include <memory>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/contact_patch.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/cutting/tet_edits.h"
#include "softbody_sim/dynamics/simulator_config.h"
#include "softbody_sim/forces/force_estimate.h"
#include "softbody_sim/object/material.h"
#include "softbody_sim/time_step/step_report.h"

namespace softbody {

/// Simulates the volumetric model under the soft constraints of each frame. Implicit Euler, solved by
/// projective dynamics (Bouaziz et al. 2014) accelerated with L-BFGS (Liu, Bouaziz, Kavan 2017), or by finite
/// elements with Newton's method.
class Simulator {
 public:
  /// @throw std::invalid_argument if topology, material or config do not describe a body.
  Simulator(const TetTopology& topology, const Material& material, const SimulatorConfig& config);
  Simulator(Simulator&& other) noexcept;
  Simulator& operator=(Simulator&& other) noexcept;
  ~Simulator();

  const TetTopology& topology() const;
  const Material& material() const;

  /// False until the first TargetSet with `reset` has placed the body.
  bool placed() const;

  /// Makes the modes for loads and standard deviations, which the first step would otherwise make. Nothing if
  /// load_fade_s is 0. @throw std::runtime_error as step does.
  void prepare();

  /// @throw std::invalid_argument if the targets fit neither the present body nor the uncut one.
  void requireUsable(const TargetSet& targets) const;

  /// Advances to `stamp` under the targets. A TargetSet with `reset` first places the rest shape at
  /// body_pose, without velocity. If `stamp` is not after the last one, no time elapses and only the targets
  /// act. If it throws, the state does not change. With projective dynamics and without estimated loads it
  /// allocates memory only in the first steps after a change of topology, or for more targets or contacts
  /// than ever before. @throw std::invalid_argument if the body is not placed, if the revision is not the
  /// topology's or one of the last few, or if a target cannot be used (tet, finite numbers, barycentric
  /// coordinates within 100, weight within largestStiffness, within reachOf() of its place in the body or in
  /// the rest shape at body_pose). @throw std::runtime_error if the step has no finite solution.
  void step(const TargetSet& targets, Nanoseconds stamp, const Surroundings& surroundings = {});

  /// Whether the body has been driven away: it is placed, but not one target is within reachOf() of its place
  /// in it. Then `reset` brings the body back. @throw std::invalid_argument as step does.
  bool hasLeft(const TargetSet& targets) const;

  /// Like step, but without a new observation. Earlier targets still act, without their `reset`. `observed`
  /// stays, and the confidence halves every 0.5 s. The
  /// standard deviation grows towards 0.1 m.
  void stepUnobserved(const TargetSet& earlier, Nanoseconds stamp, const Surroundings& surroundings = {});

  /// Static equilibrium under targets, gravity and surroundings. These must hold the body. The stamp stays,
  /// the velocity becomes zero.
  /// @throw as step does.
  void settle(const TargetSet& targets, const Surroundings& surroundings = {});

  /// Sets the vertices of a placed body to any shape, without velocity. @param vertices #V by 3 [m].
  /// @throw std::invalid_argument if the body is not placed, or the vertices are not #V finite points.
  void setVertices(const Points& vertices);

  /// Takes over edits of its tets, for example as the follower of a CuttableBody. Positions, velocities and
  /// confidences are continuous. Targets of the last few revisions are still accepted. If it throws, nothing
  /// has changed. @throw std::invalid_argument if the edits are of other tets.
  void apply(const TetEdits& edits);

  /// Converts targets of one of the last few revisions to the current one; other targets stay as they are. To
  /// keep targets through many edits, convert them after each edit.
  TargetSet toCurrentRevision(TargetSet targets) const;

  const SimulatorConfig& config() const;
  /// Changes what the body is made of and how the next steps are made. Shape, motion and cuts stay. Estimated
  /// loads and what earlier frames have measured are forgotten, with load_fade_s 0 also standard deviations.
  /// The time is that of the first construction.
  /// @throw std::invalid_argument as the constructor does; nothing has changed.
  void change(const Material& material, const SimulatorConfig& config);
  /// The same with the present config.
  void setMaterial(const Material& material);
  /// The same with the present material. Loads stay, unless load_fade_s is 0.
  void setConfig(const SimulatorConfig& config);

  /// Returns to the uncut body of the first revision, not placed. The material stays.
  void reset();

  /// A simulator of the present body, without its edits. It goes on from here on its own.
  std::unique_ptr<Simulator> copyOfPresent() const;
  /// Such a copy for many simulations from one state. Each begins with returnTo().
  std::unique_ptr<Simulator> copyForPrediction() const;
  /// Takes over the state of another simulator with the same tets. Steps from here do not depend on earlier
  /// ones of this simulator.
  void returnTo(const Simulator& other);

  const MeshState& state() const;
  /// Of the last step.
  Nanoseconds stamp() const;
  const StepReport& report() const;
  const Reactions& reactions() const;
  /// Where the body touched the obstacles in the last step.
  std::vector<ContactPatch> contactPatches() const;

  /// The forces that explain the present shape, and those on the pins without the springs of the targets. The
  /// body is taken to be in balance: slow. Costs more than a step. @param targets, @param surroundings of the
  /// last step. @throw as step does, if the body is not placed too.
  ForceEstimate externalForces(const TargetSet& targets, const Surroundings& surroundings = {});

  /// Elastic energy of the present state [J].
  double elasticEnergy() const;

 private:
  struct Implementation;

  std::unique_ptr<Simulator> copyWith(const SimulatorConfig& config) const;

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
