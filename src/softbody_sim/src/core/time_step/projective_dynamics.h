#pragma once

#include <memory>

#include "elasticity/corotated_elasticity.h"
#include "simd/simd.h"
#include "time_step/quasi_newton.h"
#include "time_step/step_solver.h"

namespace softbody {

struct ProjectiveDynamicsOptions {
  MinimizerOptions minimizer;
  bool single_precision = false;  ///< twice as fast, positions accurate to about 0.1 um
  Simd simd = Simd::kAuto;
};

/// Projective dynamics (Bouaziz et al. 2014) with corotated elasticity, accelerated by L-BFGS (Liu, Bouaziz,
/// Kavan 2017). The local step processes several tets at once in vector registers. The matrix of the global
/// step is factored only when it changes.
class ProjectiveDynamics : public StepSolver {
 public:
  /// @throw std::invalid_argument if the volume of a rest tet is not positive.
  ProjectiveDynamics(const TetTopology& topology, const ElasticMaterials& materials,
                     const ProjectiveDynamicsOptions& options);
  ~ProjectiveDynamics() override;

  StepReport minimize(const IncrementalPotential& potential, Points* x) override;
  void restart(const Points& x) override;
  double addElasticity(const Points& x, Points* gradient) const override;

  class Precision;  ///< everything that depends on the precision

 private:
  CorotatedElasticity elasticity_;
  std::unique_ptr<Precision> implementation_;
};

}  // namespace softbody
