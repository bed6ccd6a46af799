#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <vector>

#include "core/corotated_elasticity.h"
#include "core/step_potential.h"
#include "softbody_common/types.h"

namespace softbody::bench {

/// Projective dynamics as Bouaziz et al. 2014 write it down, without acceleration: each tet's deformation
/// gradient is projected by a singular value decomposition, then one sparse system that was factored once is
/// solved. The energy is the product's, in double. The yardstick of bench_projective_dynamics.
class PlainProjectiveDynamics {
 public:
  /// Factors the system for the potential's inertia and targets.
  PlainProjectiveDynamics(const TetTopology& topology, const Lame& lame, const StepPotential& potential);

  /// One local and one global step, from x to x. Targets without normals only.
  void iterate(const StepPotential& potential, Points* x);

  void localStep(const Points& x);
  void globalStep(const StepPotential& potential, Points* x);

 private:
  Tets tets_;
  std::vector<Eigen::Matrix<double, 3, 4>> shape_gradients_;
  Eigen::VectorXd volumes_;
  Lame lame_;
  std::vector<Eigen::Matrix3d> projections_;  ///< weighted sum over a tet's constraints
  Eigen::MatrixX3d right_side_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace softbody::bench
