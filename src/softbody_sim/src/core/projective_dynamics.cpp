#include "core/projective_dynamics.h"

namespace softbody {
namespace {

TetMatrix elasticMetric(const TetTopology& topology, const CorotatedElasticity& elasticity) {
  TetMatrix metric(topology.tets, topology.rest_vertices.rows());
  elasticity.addMetric(&metric);
  return metric;
}

}  // namespace

ProjectiveDynamics::ProjectiveDynamics(const TetTopology& topology, const Lame& lame,
                                       const QuasiNewton::Options& options)
    : elasticity_(topology.rest_vertices, topology.tets, lame),
      options_(options),
      metric_(elasticMetric(topology, elasticity_)),
      elastic_metric_(metric_.values()),
      solver_(metric_.lower()),
      minimizer_(topology.rest_vertices.rows()) {}

StepReport ProjectiveDynamics::minimize(const StepPotential& potential, Points* x) {
  metric_.values() = elastic_metric_;
  metric_.addToDiagonal(potential.inertia);
  potential.targets.addMetric(&metric_);
  solver_.factorize(metric_.lower());
  const auto energy = [&](const Points& trial, Points* gradient) {
    const double outer = potential.evaluate(trial, gradient);
    return outer + elasticity_.addTo(trial, gradient);
  };
  return minimizer_.minimize(energy, solver_, options_, x);
}

double ProjectiveDynamics::addElasticity(const Points& x, Points* gradient) const {
  return elasticity_.addTo(x, gradient);
}

}  // namespace softbody
