#pragma once

#include <vector>

#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/identification/material_problem.h"

namespace softbody {

/// What the simulator says of all observations.
struct Prediction {
  Points places;               ///< of the targets, in the order of the observations [m]
  Eigen::VectorXd wrenches;    ///< force and torque of each measured wrench, in this order [N, N m]
  std::vector<Points> shapes;  ///< per observation: the vertices [m]
};

/// Simulates the observations of a problem for any material, by finite elements to a tight tolerance, so that
/// its differences are smooth.
class ForwardModel {
 public:
  /// @param problem must outlive this.
  explicit ForwardModel(const MaterialProblem& problem);

  /// @throw std::runtime_error that names the observation without an equilibrium.
  Prediction predict(const Material& material);

  /// Balanced shapes start at those of a prediction from now on.
  void startAt(const Prediction& prediction) { starts_ = prediction.shapes; }

 private:
  void advance(std::size_t k);
  void settle(const Surroundings& surroundings);
  Wrench wrenchAt(const MeasuredWrench& measured, const Surroundings& surroundings) const;

  const MaterialProblem* problem_;
  bool in_sequence_;     ///< what the body does depends on how it came there
  const double edge_m_;  ///< mean
  Simulator simulator_;
  std::vector<Points> starts_;
};

}  // namespace softbody
