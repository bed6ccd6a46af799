#pragma once

#include <memory>
#include <string>

#include "softbody_common/cut.h"
#include "softbody_common/parameters.h"
#include "softbody_common/types.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/object/object_model.h"

namespace softbody {

/// Who minimises a step: projective dynamics for speed, or finite elements by Newton's method for accuracy.
enum class SolverKind { kProjectiveDynamics, kFem };

/// Elastic energies: corotated, or stable neo-Hookean (Smith, de Goes, Kim 2018), which only FEM has.
enum class Elasticity { kCorotated, kNeoHookean };

struct SimulatorConfig {
  SolverKind solver = SolverKind::kProjectiveDynamics;
  Elasticity elasticity = Elasticity::kCorotated;
  bool simulate = true;     ///< false: surface vertices go where their targets are (Kang et al. 2022, Fig. 6)
  int iterations = 20;      ///< local/global, or Newton, iterations a step at most
  double tolerance = 1e-4;  ///< stop when no vertex moves further in an iteration [mean edge lengths]
  int lbfgs_history = 5;    ///< moves that L-BFGS remembers, at most 5; 0: plain projective dynamics
  /// Share of the energy whose strains are smoothed around the vertices, so that few linear tets bend as many
  /// would; projective dynamics only. 0: none.
  double strain_smoothing = 0.7;
  bool single_precision = false;  ///< positions to about 0.1 um, at twice the speed
  std::string simd = "auto";      ///< vector instructions: auto (the widest there are), sse4, avx2 or avx512
  bool normalized_mass =
      false;  ///< the body weighs 1 kg, whatever its density (Kang et al. 2022, section 5.1)
  double target_stiffness = 10.0;  ///< stiffness of a target of weight 1, in units of E * mean edge length
  double load_fade_s =
      0.3;  ///< in which forces that were estimated from the targets fall to 1/e; 0: none are
  double max_time_step_s = 0.1;  ///< longer gaps between frames are simulated as this
  /// [m/s^2], in the frame of the targets; zero: the rest shape already hangs or lies as it does.
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  double contact_stiffness = 20.0;  ///< pressure at a depth of a mean edge length, in units of E
  double contact_spacing = 0.5;     ///< between points of the surface that feel contact [mean edge lengths]
};

/// Of a target, weight times target_stiffness, in units of E * mean edge length: beside stiffer ones the
/// body's own stiffness is lost in rounding.
double largestStiffness(const SimulatorConfig& config);

/// @throw std::invalid_argument if the solver does not have the elasticity, or targets may be too
/// stiff.
void requireConsistent(const SimulatorConfig& config);

/// @throw std::invalid_argument as Parameters and requireConsistent do.
SimulatorConfig readSimulatorConfig(Parameters& parameters);

/// How the last step ended.
struct StepReport {
  int iterations = 0;
  bool converged = false;    ///< on the tolerance; otherwise `iterations` is the cap
  double last_move_m = 0.0;  ///< largest move of a vertex in the last iteration [m]
  double residual_n =
      0.0;  ///< largest force on a vertex that was left unbalanced when the last iteration began or ended [N]
};

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
  TargetSet broughtUpToDate(TargetSet targets) const;

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
