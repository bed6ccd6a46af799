#pragma once

#include <memory>
#include <vector>

#include "elasticity/elastic_blocks.h"
#include "fem/fem_elasticity.h"
#include "linear_solvers/hessian_factor.h"
#include "tets/block_tet_matrix.h"
#include "time_step/force_balance.h"
#include "time_step/packed_potential.h"
#include "time_step/quasi_newton.h"
#include "time_step/step_solver.h"

namespace softbody {

/// Many short simulations from one shape: the energy of projective dynamics, by L-BFGS with the Hessian at
/// that shape as metric. It knows how soft bending is, so a step takes a few iterations. Where they become
/// many, the Hessian is that of the present shape. A simulation depends neither on earlier ones nor on their
/// number.
class PredictionSolver : public StepSolver {
 public:
  /// @throw std::invalid_argument if the volume of a rest tet is not positive.
  PredictionSolver(const TetTopology& topology, const ElasticMaterials& materials,
                   const MinimizerOptions& options, Simd simd);

  void restart(const Points& x) override;
  StepReport minimize(const IncrementalPotential& potential, Points* x) override;
  double addElasticity(const Points& x, Points* gradient) const override;

 private:
  /// A factor of the Hessian, and what it was made for.
  struct Factor {
    explicit Factor(const BlockTetMatrix& pattern) : solver(pattern.lower()) {}
    Eigen::VectorXd inertia;  ///< empty: no factor
    HessianFactor solver;

    bool isFor(const IncrementalPotential& potential) const {
      return inertia.size() == potential.inertia.size() && inertia == potential.inertia;
    }
  };

  void setElasticHessian(const Points& x);
  void factorize(const IncrementalPotential& potential, const Points& x, Factor* factor);
  void chooseFactor(const IncrementalPotential& potential, const Points& x);
  StepEnergy evaluate(const IncrementalPotential& potential, const Rows<double>& x, Rows<double>* gradient);

  const MinimizerOptions options_;
  CorotatedElasticity corotated_;
  mutable ElasticBlocks<double> elasticity_;
  FemElasticity fem_;
  BlockTetMatrix hessian_, elastic_hessian_;
  Points first_shape_;                          ///< of all simulations
  bool is_first_ = false;                       ///< elastic_hessian_ is that of first_shape_
  std::vector<std::unique_ptr<Factor>> first_;  ///< at the first shape, without contact
  Factor present_;                              ///< with contact, or at a later shape
  Factor* factor_ = nullptr;
  PackedPotential<double> step_;
  ForceBalance<Rows<double>> balance_;
  QuasiNewton<Rows<double>> minimizer_;
  mutable Rows<double> x_, gradient_;
};

}  // namespace softbody
