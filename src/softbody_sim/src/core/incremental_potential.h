#pragma once

#include <Eigen/Core>

#include "core/corotated_elasticity.h"
#include "core/target_energy.h"
#include "core/tet_matrix.h"
#include "softbody_common/types.h"

namespace softbody {

/// What one step of implicit Euler minimises (Bouaziz et al. 2014, eq. 4; Kang et al. 2022, section 5.2):
///   1/(2 h^2) |x - prediction|_M^2 + elasticity + targets.
struct IncrementalPotential {
  const CorotatedElasticity& elasticity;
  const TargetEnergy& targets;
  Eigen::VectorXd inertia;  ///< lumped masses / h^2 [N/m]
  Points prediction;        ///< where the vertices go without forces [m]

  /// Energy [J] and its gradient [N].
  double evaluate(const Points& x, Points* gradient) const;
};

}  // namespace softbody
