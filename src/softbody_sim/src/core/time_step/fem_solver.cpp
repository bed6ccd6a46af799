#include "time_step/fem_solver.h"

#include <Eigen/CholmodSupport>
#include <cmath>
#include <stdexcept>

namespace softbody {

struct FemSolver::Factor : Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower> {
  bool is_coupled = false;  ///< the analysed pattern couples tets
};

namespace {

double roundingOf(const StepEnergy& energy) { return 1e-12 * std::abs(energy.energy_j); }

}  // namespace

FemSolver::FemSolver(const TetTopology& topology, Elasticity elasticity, const ElasticMaterials& materials,
                     const Options& options)
    : elasticity_(topology, elasticity, materials),
      options_(options),
      hessian_(elasticity_.groups(), topology.rest_vertices.rows()),
      factor_(std::make_unique<Factor>()),
      gradient_(topology.rest_vertices.rows(), 3),
      direction_(gradient_),
      trial_(gradient_),
      trial_gradient_(gradient_) {
  factor_->cholmod().print = 0;
  factor_->setMode(Eigen::CholmodSupernodalLLt);  // LDL' would accept an indefinite matrix
  factor_->analyzePattern(hessian_.lower());
}

FemSolver::~FemSolver() = default;

StepReport FemSolver::minimize(const IncrementalPotential& potential, Points* x) {
  StepReport report;
  energy_ = evaluate(potential, *x, &gradient_);
  const auto balanced = [&] {
    return std::isfinite(energy_.external_n) &&
           energy_.unbalanced_n <= options_.tolerance * energy_.external_n;
  };
  report.converged = balanced();
  double step = 0.0;
  while (report.iterations < options_.max_iterations && !report.converged) {
    ++report.iterations;
    // Near the end the exact Hessian converges quadratically; the projected one may not.
    if (step < 1.0 || !findDirection(potential, *x, Hessian::kExact))
      findDirection(potential, *x, Hessian::kProjected);
    step = 1.0;
    const StepEnergy before = energy_;
    // If no step along a descent direction lowers the energy, the rest is rounding.
    if (!searchLine(potential, x, &step)) break;
    report.last_move_m = step * direction_.rowwise().norm().maxCoeff();
    report.converged = balanced();
    // So it is if neither the energy nor the forces fall; Newton's method would at least halve them.
    if (before.energy_j - energy_.energy_j <= roundingOf(before) &&
        2.0 * energy_.unbalanced_n > before.unbalanced_n)
      break;
  }
  report.residual_n = energy_.unbalanced_n;
  report.external_n = energy_.external_n;
  return report;
}

double FemSolver::addElasticity(const Points& x, Points* gradient) const {
  return elasticity_.addTo(x, gradient);
}

StepEnergy FemSolver::evaluate(const IncrementalPotential& potential, const Points& x, Points* gradient) {
  const auto add = [&](Points* sum) { return elasticity_.addTo(x, sum); };
  return balance_.complete(potential, potential.evaluate(x, gradient), add, gradient);
}

/// False if the exact Hessian is not positive definite. The projected one is singular only for a body without
/// inertia that nothing holds; then a growing shift makes it definite (Levenberg's method).
bool FemSolver::findDirection(const IncrementalPotential& potential, const Points& x, Hessian kind) {
  hessian_.setZero();
  hessian_.addToDiagonal(potential.inertia);
  potential.targets.addHessian(x, &hessian_);
  elasticity_.addHessian(x, &hessian_, kind == Hessian::kProjected);
  const Eigen::SparseMatrix<double>& system = systemAt(potential, x);
  if (solveShifted(system, 0.0)) return true;
  if (kind == Hessian::kExact) return false;
  const double mean = hessian_.lower().diagonal().mean();
  for (double shift = 1e-10; shift <= 1.0; shift *= 100.0) {
    if (solveShifted(system, shift * mean)) return true;
  }
  throw std::runtime_error("the Hessian could not be made positive definite");
}

/// Contacts change which tets are coupled. So the matrix pattern is analysed in each call that has couplings.
const Eigen::SparseMatrix<double>& FemSolver::systemAt(const IncrementalPotential& potential,
                                                       const Points& x) {
  const bool is_coupled = potential.targets.hasCoupled();
  if (!is_coupled && !factor_->is_coupled) return hessian_.lower();
  std::vector<Eigen::Triplet<double>> entries;
  potential.targets.addCouplings(x, &entries);
  coupled_hessian_.resize(hessian_.lower().rows(), hessian_.lower().cols());
  coupled_hessian_.setFromTriplets(entries.begin(), entries.end());
  coupled_hessian_ += hessian_.lower();
  factor_->analyzePattern(coupled_hessian_);
  factor_->is_coupled = is_coupled;
  return coupled_hessian_;
}

bool FemSolver::solveShifted(const Eigen::SparseMatrix<double>& system, double shift) {
  factor_->setShift(shift);
  factor_->factorize(system);
  if (factor_->info() != Eigen::Success) return false;
  const Eigen::Map<const Eigen::VectorXd> right(gradient_.data(), gradient_.size());
  Eigen::Map<Eigen::VectorXd>(direction_.data(), direction_.size()) = -factor_->solve(right);
  return direction_.allFinite();
}

/// Halves the step until the energy falls enough (Armijo). Where the fall is below the rounding of the
/// energy, the slope tells instead (approximate Wolfe condition, Hager and Zhang 2005, eq. 4.1). If neither
/// holds for any step, returns false and leaves x.
bool FemSolver::searchLine(const IncrementalPotential& potential, Points* x, double* step) {
  constexpr double kArmijo = 1e-4;  // Nocedal and Wright 2006, section 3.1
  constexpr int kMaxHalvings = 20;  // then a step is a millionth: rounding
  const double slope = gradient_.cwiseProduct(direction_).sum();
  const double rounding = roundingOf(energy_);
  for (int halving = 0; halving < kMaxHalvings; ++halving, *step *= 0.5) {
    trial_ = *x + *step * direction_;
    const StepEnergy trial = evaluate(potential, trial_, &trial_gradient_);
    const double rise = trial.energy_j - energy_.energy_j;
    const double trial_slope = trial_gradient_.cwiseProduct(direction_).sum();
    const bool slope_vanishes = rise <= rounding && std::abs(trial_slope) <= (1.0 - 2.0 * kArmijo) * -slope;
    if (!(rise <= kArmijo * *step * slope) && !slope_vanishes) continue;
    energy_ = trial;
    x->swap(trial_);
    gradient_.swap(trial_gradient_);
    return true;
  }
  return false;
}

}  // namespace softbody
