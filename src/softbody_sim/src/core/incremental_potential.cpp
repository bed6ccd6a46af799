#include "core/incremental_potential.h"

namespace softbody {

double IncrementalPotential::evaluate(const Points& x, Points* gradient) const {
  double energy = 0.0;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const Eigen::RowVector3d offset = x.row(v) - prediction.row(v);
    energy += 0.5 * inertia[v] * offset.squaredNorm();
    gradient->row(v) = inertia[v] * offset;
  }
  energy += elasticity.addTo(x, gradient);
  energy += targets.addTo(x, gradient);
  return energy;
}

}  // namespace softbody
