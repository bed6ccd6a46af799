#pragma once

#include <Eigen/Core>

#include "core/corotated_elasticity.h"
#include "core/positive_definite_solver.h"
#include "core/quasi_newton.h"
#include "core/step_solver.h"
#include "core/tet_matrix.h"

namespace softbody {

/// Projective dynamics (Bouaziz et al. 2014) with corotated elasticity, accelerated by L-BFGS (Liu, Bouaziz,
/// Kavan 2017).
class ProjectiveDynamics : public StepSolver {
 public:
  /// @param options.tolerance_m in metres. @throw std::invalid_argument if a rest tet has no positive volume.
  ProjectiveDynamics(const TetTopology& topology, const Lame& lame, const QuasiNewton::Options& options);

  StepReport minimize(const StepPotential& potential, Points* x) override;
  double addElasticity(const Points& x, Points* gradient) const override;

 private:
  CorotatedElasticity elasticity_;
  QuasiNewton::Options options_;
  TetMatrix metric_;
  const Eigen::VectorXd elastic_metric_;  ///< the metric's values that never change
  PositiveDefiniteSolver solver_;
  QuasiNewton minimizer_;
};

}  // namespace softbody
