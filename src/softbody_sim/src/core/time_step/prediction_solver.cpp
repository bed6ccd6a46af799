#include "time_step/prediction_solver.h"

#include <algorithm>
#include <stdexcept>

namespace softbody {
namespace {

/// Iterations with an older Hessian. After them, a Hessian of the present shape costs less than more
/// iterations.
constexpr int kManyIterations = 20;

/// Plans of a call differ in what holds the body: not at all, by the pins of the present, by one grip.
constexpr std::size_t kFirstFactors = 4;

}  // namespace

PredictionSolver::PredictionSolver(const TetTopology& topology, const ElasticMaterials& materials,
                                   const MinimizerOptions& options, Simd simd)
    : options_(options),
      corotated_(topology.rest_vertices, topology.tets, materials),
      elasticity_(topology.rest_vertices, corotated_, simd),
      fem_(topology, Elasticity::kCorotated, materials),
      hessian_(fem_.groups(), topology.rest_vertices.rows()),
      elastic_hessian_(hessian_),
      present_(hessian_),
      step_(topology.rest_vertices.rows(), simd),
      minimizer_(paddedRows(topology.rest_vertices.rows())),
      x_(Rows<double>::Zero(paddedRows(topology.rest_vertices.rows()), 4)),
      gradient_(x_) {
  restart(topology.rest_vertices);
}

void PredictionSolver::restart(const Points& x) {
  factor_ = nullptr;
  if (first_shape_.rows() == x.rows() && first_shape_ == x) return;
  first_shape_ = x;
  first_.clear();
  is_first_ = false;
}

void PredictionSolver::setElasticHessian(const Points& x) {
  elastic_hessian_.setZero();
  fem_.addHessian(x, &elastic_hessian_);
}

void PredictionSolver::factorize(const IncrementalPotential& potential, const Points& x, Factor* factor) {
  hessian_ = elastic_hessian_;
  hessian_.addToDiagonal(potential.inertia);
  potential.targets.addHessian(x, &hessian_);
  factor->inertia.resize(0);
  if (!factor->solver.factorize(hessian_.lower()))
    throw std::runtime_error("the system matrix is not positive definite");
  factor->inertia = potential.inertia;
  factor_ = factor;
}

/// The factors of the first shape serve all simulations whose inertia and pins are equal.
void PredictionSolver::chooseFactor(const IncrementalPotential& potential, const Points& x) {
  if (factor_ && factor_->isFor(potential)) return;
  if (!is_first_) setElasticHessian(first_shape_);
  is_first_ = true;
  if (potential.targets.hasContact()) return factorize(potential, x, &present_);
  for (const auto& factor : first_) {
    if (!factor->isFor(potential)) continue;
    factor_ = factor.get();
    return;
  }
  if (first_.size() < kFirstFactors)
    first_.push_back(std::make_unique<Factor>(hessian_));
  else
    std::rotate(first_.begin(), first_.begin() + 1, first_.end());
  factorize(potential, x, first_.back().get());
}

StepEnergy PredictionSolver::evaluate(const IncrementalPotential& potential, const Rows<double>& x,
                                      Rows<double>* gradient) {
  const auto add = [&](Rows<double>* sum) { return elasticity_.addTo(x, sum); };
  return balance_.complete(potential, step_.evaluate(x, gradient), add, gradient);
}

StepReport PredictionSolver::minimize(const IncrementalPotential& potential, Points* x) {
  step_.set(potential, potential.prediction.colwise().mean());
  step_.toRows(*x, &x_);
  const auto energy = [&](const Rows<double>& trial, Rows<double>* gradient) {
    return evaluate(potential, trial, gradient);
  };
  const auto metric = [&](const Rows<double>& B, Rows<double>* X) { factor_->solver.solve(B, X); };
  chooseFactor(potential, *x);
  StepReport report;
  MinimizerOptions part = options_;
  for (int done = 0; done < options_.max_iterations; done += part.max_iterations) {
    part.max_iterations = std::min(kManyIterations, options_.max_iterations - done);
    const int before = report.iterations;
    report = minimizer_.minimize(energy, metric, part, &x_);
    const int iterations = report.iterations;
    report.iterations += before;
    step_.fromRows(x_, x);
    if (report.converged || iterations < part.max_iterations) break;
    // Contacts change faster than the shape, and their Hessian costs less.
    if (done > 0) {
      setElasticHessian(*x);
      is_first_ = false;
    }
    factorize(potential, *x, &present_);
  }
  return report;
}

double PredictionSolver::addElasticity(const Points& x, Points* gradient) const {
  x_.topLeftCorner(x.rows(), 3) = x;
  gradient_.setZero();
  const double energy = elasticity_.addTo(x_, &gradient_);
  *gradient += gradient_.topLeftCorner(x.rows(), 3);
  return energy;
}

}  // namespace softbody
