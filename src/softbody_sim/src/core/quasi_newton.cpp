#include "core/quasi_newton.h"

#include <array>
#include <cmath>

namespace softbody {
namespace {

double dot(const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); }

double longestRow(const Points& points) { return std::sqrt(points.rowwise().squaredNorm().maxCoeff()); }

}  // namespace

QuasiNewton::QuasiNewton(Eigen::Index vertex_count)
    : pairs_(kHistory),
      gradient_(vertex_count, 3),
      direction_(vertex_count, 3),
      residual_(vertex_count, 3),
      trial_(vertex_count, 3),
      trial_gradient_(vertex_count, 3),
      trial_gradient_change_(vertex_count, 3) {
  for (Pair& pair : pairs_) {
    pair.move.resize(vertex_count, 3);
    pair.gradient_change.resize(vertex_count, 3);
  }
}

StepReport QuasiNewton::minimize(const Energy& energy, PositiveDefiniteSolver& metric, const Options& options,
                                 Points* x) {
  StepReport report;
  pair_count_ = 0;
  energy_ = energy(*x, &gradient_);
  while (report.iterations < options.max_iterations && !report.converged) {
    ++report.iterations;
    findDirection(metric);
    double step = 1.0;
    if (!searchLine(energy, x, &step)) {
      // Nothing to gain along the steepest direction of the metric: a minimum within rounding.
      report.converged = pair_count_ == 0;
      pair_count_ = 0;
      continue;
    }
    report.last_move_m = step * longestRow(direction_);
    report.converged = step == 1.0 && report.last_move_m < options.tolerance_m;
  }
  return report;
}

/// The two-loop recursion (Nocedal and Wright 2006, algorithm 7.4).
void QuasiNewton::findDirection(PositiveDefiniteSolver& metric) {
  std::array<double, kHistory> alpha{};
  residual_ = gradient_;
  for (int age = 0; age < pair_count_; ++age) {
    const Pair& pair = recent(age);
    alpha[age] = pair.inverse_product * dot(pair.move, residual_);
    residual_ -= alpha[age] * pair.gradient_change;
  }
  metric.solve(residual_, &direction_);
  for (int age = pair_count_ - 1; age >= 0; --age) {
    const Pair& pair = recent(age);
    direction_ += (alpha[age] - pair.inverse_product * dot(pair.gradient_change, direction_)) * pair.move;
  }
  direction_ = -direction_;
}

/// Halves the step until the energy falls enough (Armijo); false, x as it was, if it never does.
bool QuasiNewton::searchLine(const Energy& energy, Points* x, double* step) {
  constexpr double kArmijo = 1e-4;
  constexpr int kMaxHalvings = 12;
  const double slope = dot(gradient_, direction_);
  if (!(slope < 0.0)) return false;
  for (int halving = 0; halving < kMaxHalvings; ++halving, *step *= 0.5) {
    trial_ = *x + *step * direction_;
    const double trial_energy = energy(trial_, &trial_gradient_);
    if (trial_energy <= energy_ + kArmijo * *step * slope) {
      energy_ = trial_energy;
      residual_ = trial_ - *x;
      remember();
      x->swap(trial_);
      gradient_.swap(trial_gradient_);
      return true;
    }
  }
  return false;
}

/// Keeps the accepted move (in residual_) where the curvature along it is positive, as the update needs.
void QuasiNewton::remember() {
  trial_gradient_change_ = trial_gradient_ - gradient_;
  const double product = dot(residual_, trial_gradient_change_);
  if (!(product > 1e-12 * residual_.norm() * trial_gradient_change_.norm())) return;
  newest_ = (newest_ + 1) % kHistory;
  Pair& pair = recent(0);
  pair.move.swap(residual_);
  pair.gradient_change.swap(trial_gradient_change_);
  pair.inverse_product = 1.0 / product;
  if (pair_count_ < kHistory) ++pair_count_;
}

}  // namespace softbody
