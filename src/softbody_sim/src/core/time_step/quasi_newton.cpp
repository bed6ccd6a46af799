#include "time_step/quasi_newton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "simd/rows.h"

namespace softbody {
namespace {

/// Of an energy, relative: sums of many terms.
template <typename Scalar>
constexpr double kRounding = std::is_same_v<Scalar, float> ? 1e-6 : 1e-14;

template <typename Positions>
double dot(const Positions& a, const Positions& b) {
  return static_cast<double>(a.cwiseProduct(b).sum());
}

template <typename Positions>
double longestRow(const Positions& points) {
  using Scalar = typename Positions::Scalar;
  // Four maxima in parallel, because each step of one maximum waits for the step before.
  constexpr Eigen::Index kSideBySide = 4;
  std::array<Scalar, kSideBySide> longest{};
  const auto include = [&](Eigen::Index v, Eigen::Index k) {
    const Scalar x = points(v, 0), y = points(v, 1), z = points(v, 2), squared = x * x + y * y + z * z;
    longest[k] = longest[k] < squared ? squared : longest[k];
  };
  Eigen::Index v = 0;
  for (; v + kSideBySide <= points.rows(); v += kSideBySide) {
    for (Eigen::Index k = 0; k < kSideBySide; ++k) include(v + k, k);
  }
  for (; v < points.rows(); ++v) include(v, 0);
  return std::sqrt(static_cast<double>(*std::max_element(longest.begin(), longest.end())));
}

}  // namespace

template <typename Positions>
QuasiNewton<Positions>::QuasiNewton(Eigen::Index rows) : pairs_(kHistory) {
  for (Positions* p :
       {&gradient_, &direction_, &residual_, &trial_, &trial_gradient_, &trial_gradient_change_}) {
    p->setZero(rows, Positions::ColsAtCompileTime);
  }
  for (Pair& pair : pairs_) {
    pair.move.setZero(rows, Positions::ColsAtCompileTime);
    pair.gradient_change.setZero(rows, Positions::ColsAtCompileTime);
  }
}

template <typename Positions>
StepReport QuasiNewton<Positions>::minimize(const Energy& energy, const Metric& metric,
                                            const MinimizerOptions& options, Positions* x) {
  if (options.history == 0) return iterate(energy, metric, options, x);
  StepReport report;
  history_ = std::min(options.history, kHistory);
  pair_count_ = 0;
  extent_ = static_cast<double>(x->cwiseAbs().maxCoeff());
  energy_ = energy(*x, &gradient_);
  report.converged = isBalanced(options);
  lowest_n_ = energy_.unbalanced_n;
  idle_ = 0;
  while (report.iterations < options.max_iterations && !report.converged) {
    ++report.iterations;
    findDirection(metric);
    const double before = energy_.energy_j;
    double step = 1.0;
    if (!searchLine(energy, x, &step)) {
      // No gain along the steepest direction of the metric: the rest is rounding.
      if (pair_count_ == 0) break;
      pair_count_ = 0;
      continue;
    }
    report.last_move_m = step * longestRow(direction_);
    report.converged = isBalanced(options);
    if (isRounding(before)) break;
  }
  describe(&report);
  return report;
}

template <typename Positions>
bool QuasiNewton<Positions>::isBalanced(const MinimizerOptions& options) const {
  return std::isfinite(energy_.external_n) && energy_.unbalanced_n <= options.tolerance * energy_.external_n;
}

/// Error of the energy: of its sum, and of the forces' work along the rounding of the positions.
template <typename Positions>
double QuasiNewton<Positions>::rounding() const {
  constexpr double kEpsilon = std::numeric_limits<Scalar>::epsilon();
  return kRounding<Scalar> * std::abs(energy_.energy_j) + kEpsilon * extent_ * energy_.external_n;
}

/// Whether several iterations gained nothing: neither the energy nor the unbalanced forces fell.
template <typename Positions>
bool QuasiNewton<Positions>::isRounding(double energy_before) {
  const bool falls = energy_before - energy_.energy_j > kRounding<Scalar> * std::abs(energy_before);
  idle_ = falls || energy_.unbalanced_n < lowest_n_ ? 0 : idle_ + 1;
  lowest_n_ = std::min(lowest_n_, energy_.unbalanced_n);
  // Forces of a nearly incompressible body rise for up to a hundred iterations before they fall again.
  constexpr int kPatience = 200;
  return idle_ > kPatience;
}

template <typename Positions>
void QuasiNewton<Positions>::describe(StepReport* report) const {
  report->residual_n = energy_.unbalanced_n;
  report->external_n = energy_.external_n;
}

/// Local and global steps of projective dynamics. They need no line search: the metric bounds the curvature
/// of every term, so no iteration can raise the energy (Bouaziz et al. 2014, section 3).
template <typename Positions>
StepReport QuasiNewton<Positions>::iterate(const Energy& energy, const Metric& metric,
                                           const MinimizerOptions& options, Positions* x) {
  StepReport report;
  while (report.iterations < options.max_iterations && !report.converged) {
    energy_ = energy(*x, &gradient_);
    report.converged = isBalanced(options);
    if (report.converged) break;
    ++report.iterations;
    metric(gradient_, &direction_);
    *x -= direction_;
    report.last_move_m = longestRow(direction_);
  }
  describe(&report);
  return report;
}

/// The two-loop recursion (Nocedal and Wright 2006, algorithm 7.4).
template <typename Positions>
void QuasiNewton<Positions>::findDirection(const Metric& metric) {
  std::array<double, kHistory> alpha{};
  residual_ = gradient_;
  for (int age = 0; age < pair_count_; ++age) {
    const Pair& pair = recent(age);
    alpha[age] = pair.inverse_product * dot(pair.move, residual_);
    residual_ -= static_cast<Scalar>(alpha[age]) * pair.gradient_change;
  }
  metric(residual_, &direction_);
  for (int age = pair_count_ - 1; age >= 0; --age) {
    const Pair& pair = recent(age);
    direction_ +=
        static_cast<Scalar>(alpha[age] - pair.inverse_product * dot(pair.gradient_change, direction_)) *
        pair.move;
  }
  direction_ = -direction_;
}

/// Halves the step until the energy falls enough. If it never does, returns false and leaves x.
template <typename Positions>
bool QuasiNewton<Positions>::searchLine(const Energy& energy, Positions* x, double* step) {
  constexpr int kMaxHalvings = 30;  // a free fall of 10 mm may meet a contact after 10 nm
  const double slope = dot(gradient_, direction_);
  if (!(slope < 0.0)) return false;
  for (int halving = 0; halving < kMaxHalvings; ++halving, *step *= 0.5) {
    trial_ = *x + static_cast<Scalar>(*step) * direction_;
    const StepEnergy trial_energy = energy(trial_, &trial_gradient_);
    if (fallsEnough(trial_energy.energy_j, slope, *step)) {
      energy_ = trial_energy;
      residual_ = trial_ - *x;
      storeMove();
      x->swap(trial_);
      gradient_.swap(trial_gradient_);
      return true;
    }
  }
  return false;
}

/// Armijo's condition. The difference of two energies is lost in rounding before the minimum; then the slope
/// at the end of the step decides (approximate Wolfe condition, Hager and Zhang 2005).
template <typename Positions>
bool QuasiNewton<Positions>::fallsEnough(double trial_energy, double slope, double step) const {
  constexpr double kArmijo = 1e-4;  // Nocedal and Wright 2006, section 3.1
  if (trial_energy <= energy_.energy_j + kArmijo * step * slope) return true;
  return trial_energy <= energy_.energy_j + rounding() &&
         dot(trial_gradient_, direction_) <= (2.0 * kArmijo - 1.0) * slope;
}

/// Stores the accepted move (in residual_) if the curvature along it is positive, as L-BFGS needs.
template <typename Positions>
void QuasiNewton<Positions>::storeMove() {
  trial_gradient_change_ = trial_gradient_ - gradient_;
  const double product = dot(residual_, trial_gradient_change_);
  if (!(product > 1e-12 * residual_.norm() * trial_gradient_change_.norm())) return;
  newest_ = (newest_ + 1) % kHistory;
  Pair& pair = recent(0);
  pair.move.swap(residual_);
  pair.gradient_change.swap(trial_gradient_change_);
  pair.inverse_product = 1.0 / product;
  if (pair_count_ < history_) ++pair_count_;
}

template class QuasiNewton<Points>;
template class QuasiNewton<Rows<float>>;
template class QuasiNewton<Rows<double>>;

}  // namespace softbody
