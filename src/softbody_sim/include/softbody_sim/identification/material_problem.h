#pragma once

#include <limits>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/dynamics/simulator_config.h"
#include "softbody_sim/object/material.h"

namespace softbody {

/// A wrench that was measured at pins or at an obstacle, in the targets' frame.
struct MeasuredWrench {
  std::vector<int> vertices;                         ///< whose pins it sums; empty: it is at the obstacle
  int obstacle = -1;                                 ///< index in the surroundings
  int sensor = 0;                                    ///< wrenches of one sensor have the same number
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the torque [m]
  Wrench value;                                      ///< of the body on what holds or touches it
  double force_std_n = 0.0;                          ///< of each component, above 0
  double torque_std_nm = 0.0;                        ///< of each component; 0: the torque was not measured
};

/// What was measured while the surroundings were the same.
struct ShapeObservation {
  Nanoseconds stamp = 0;
  std::vector<Target> targets;  ///< of one image or of several; measurements, the body does not feel them
  std::vector<int> images;      ///< per target, of which image it is, ascending over all observations
  Surroundings surroundings;
  std::vector<MeasuredWrench> wrenches;
};

/// Which properties are to be found, of the body and of each region of its material.
struct FreeProperties {
  bool youngs_modulus = true;
  bool poisson_ratio = false;
  bool damping = false;
};

/// A body, what acts on it, and how it was seen to deform.
struct MaterialProblem {
  TetTopology topology;
  Material prior;             ///< start of the search; what is not free stays
  SimulatorConfig simulator;  ///< gravity, elasticity, smoothing and contact
  FreeProperties free;
  /// Standard deviation of the mass, relative; infinite: the mass is not known.
  double mass_std = std::numeric_limits<double>::infinity();
  Eigen::Isometry3d body_pose =
      Eigen::Isometry3d::Identity();  ///< rest frame in the targets' frame, at first
  bool align = true;                  ///< the targets may be off by a rigid motion, which is found, too
  /// False: the body is in balance in each observation. True: it moves from one to the next, and is in
  /// balance in the first.
  bool moves = false;
  double time_step_s = 0.002;                  ///< longest, if it moves
  std::vector<ShapeObservation> observations;  ///< by stamp
};

/// @throw std::invalid_argument that says which observation cannot be used, and why.
void requireUsable(const MaterialProblem& problem);

}  // namespace softbody
