#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// A rigid motion over time, in the frame of the targets. It starts with the identity at time 0.
struct RigidPath {
  std::vector<double> times_s;  ///< ascending, above 0
  std::vector<Eigen::Isometry3d> motions;

  /// Linear between two times; the last motion stays. The identity without times.
  Eigen::Isometry3d at(double time_s) const;
};

/// What a prediction assumes about the surroundings.
struct MotionPlan {
  Surroundings start;                ///< at the present state
  std::vector<RigidPath> pins;       ///< per pin
  std::vector<RigidPath> obstacles;  ///< per obstacle
};

struct PredictedState {
  double time_s = 0.0;    ///< from the present state
  bool converged = true;  ///< all steps up to this time
  Surroundings surroundings;
  Points vertices;  ///< [m]
  Reactions reactions;
};

/// Simulates each plan from the present state of a placed body, which does not change. Each plan has a
/// simulator of its own. So the result depends neither on the other plans nor on the number of threads.
/// @param times_s ascending; a state is that after the first step that reaches its time.
/// @return per plan, per time. @throw as Simulator::step does.
std::vector<std::vector<PredictedState>> predict(const Simulator& present,
                                                 const std::vector<MotionPlan>& plans,
                                                 const std::vector<double>& times_s, double time_step_s,
                                                 int threads);

}  // namespace softbody
