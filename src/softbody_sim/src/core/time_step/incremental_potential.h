#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/target_energy.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// The incremental potential of an implicit Euler step, without the elastic energy (Bouaziz et al. 2014, eq.
/// 4; Kang et al. 2022, section 5.2): 1/(2 h^2) |x - prediction|_M^2 - loads . (x - prediction) + targets.
/// The spring of a pin is added to the inertia and the prediction of its vertex.
struct IncrementalPotential {
  Eigen::VectorXd inertia;  ///< #V: lumped masses / h^2 [N/m]
  Points prediction;        ///< #V by 3: positions without forces [m]
  Points loads;             ///< #V by 3: external forces, including gravity [N]
  TargetEnergy targets;
  std::vector<int> pinned = {};    ///< vertices whose pins are as stiff as the solver allows
  double reference_force_n = 0.0;  ///< of the loads, and a force that moves a free body noticeably [N]

  /// Energy [J]; sets its gradient [N], #V by 3.
  double evaluate(const Points& x, Points* gradient) const;
};

}  // namespace softbody
