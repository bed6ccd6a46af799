#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_sim/elasticity/elasticity.h"

namespace softbody {

/// The minimiser of a step: projective dynamics for speed, finite elements with Newton's method for accuracy,
/// or the energy of projective dynamics for many simulations from one state (predict()).
enum class SolverKind { kProjectiveDynamics, kFem, kPrediction };

struct SimulatorConfig {
  SolverKind solver = SolverKind::kProjectiveDynamics;
  Elasticity elasticity = Elasticity::kCorotated;
  int iterations = 20;  ///< maximum of a step: local/global iterations, or Newton iterations
  /// A step has converged when the sum of the unbalanced forces is this share of that of the external forces.
  double tolerance = 2e-4;
  int lbfgs_history = 5;  ///< moves that L-BFGS keeps, at most 5; 0: plain projective dynamics
  /// Fraction of the shear energy that uses strains smoothed around the vertices. It reduces the locking of
  /// linear tets in bending. 0: no smoothing.
  double strain_smoothing = 0.7;
  std::optional<double> volume_smoothing;  ///< the same of the volume energy; empty: volumeSmoothing(nu)
  bool single_precision = false;           ///< twice as fast, positions accurate to about 0.1 um
  std::string simd = "auto";       ///< vector instructions: auto (the widest available), sse4, avx2 or avx512
  double target_stiffness = 10.0;  ///< of a target of weight 1, in units of E * mean edge length
  double load_fade_s = 0.1;  ///< time in which what is known of loads falls to 1/e; 0: they are not estimated
  double memory_s = 0.5;     ///< time over which measurements of a body at rest are averaged; 0: they are not
  double max_time_step_s = 0.1;  ///< longer gaps between frames are simulated as a step of this length
  /// [m/s^2], in the frame of the targets. Zero: the rest shape already contains the effect of gravity.
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  bool self_contact = false;   ///< the body touches itself, in steps without targets
  double self_friction = 0.0;  ///< coefficient of Coulomb friction of the body on itself
};

/// Maximum of weight times target_stiffness, in units of E * mean edge length. With stiffer targets, the
/// body's own stiffness would be lost in rounding.
double largestStiffness(const SimulatorConfig& config);

/// @throw std::invalid_argument if the solver does not offer the elasticity, if springs are to be smoothed,
/// or if targets could be too stiff.
void requireConsistent(const SimulatorConfig& config);

/// The solver for many simulations from one state.
SimulatorConfig configForPrediction(SimulatorConfig config);

/// Their check is requireConsistent.
const ParameterTable<SimulatorConfig>& simulatorParameters();

}  // namespace softbody
