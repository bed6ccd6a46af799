#include "identification/material_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

/// Differences of the unknowns for derivatives. The simulation is smooth to far less.
constexpr double kDifference = 1e-4;

/// Residuals above this many of their usual size count less (Huber: 95 % efficient for normal errors).
constexpr double kHuber = 1.345;

/// A target cannot be known better than to this share of its stated deviation.
constexpr double kLeastNoise = 1e-3;

/// The search ends at a smaller fall of the sum of squares. One standard error makes a fall of 1.
constexpr double kNegligible = 1e-3;

/// Longest step of an unknown in one iteration: beyond it the shape is not linear in it.
double longestStep(const Unknown& unknown) {
  return unknown.property == Property::kYoungsModulus || unknown.property == Property::kDensity ? 1.0 : 0.2;
}

Eigen::Vector3d centerOf(const MaterialProblem& problem) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const ShapeObservation& observation : problem.observations)
    for (const Target& target : observation.targets) sum += target.position, count += 1.0;
  return count > 0.0 ? Eigen::Vector3d(sum / count) : sum;
}

double sizeOf(const Points& vertices) {
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

/// The alignment after a shift and a turn about a point.
Eigen::Isometry3d moved(const Eigen::Isometry3d& alignment, const Eigen::Matrix<double, 6, 1>& move,
                        const Eigen::Vector3d& center) {
  return rigidMotion(move.tail<3>(), move.head<3>(), center) * alignment;
}

}  // namespace

MaterialFit::MaterialFit(const MaterialProblem& problem, std::vector<Unknown> unknowns)
    : problem_(&problem),
      unknowns_(std::move(unknowns)),
      model_(problem),
      residuals_(problem),
      center_(centerOf(problem)),
      size_m_(sizeOf(problem.topology.rest_vertices)) {
  state_ = evaluate(valuesOf(problem.prior, unknowns_), Eigen::Isometry3d::Identity());
  if (problem.align) align();
  setWeights();
}

/// The rigid motion alone, with the shapes as they are.
void MaterialFit::align() {
  for (int iteration = 0; iteration < 30; ++iteration) {
    setWeights();
    Eigen::MatrixXd rows = residuals_.byAlignment(state_.prediction, state_.alignment, center_);
    rows = weights_.asDiagonal() * rows;
    Eigen::Matrix<double, 6, 6> information = rows.transpose() * rows;
    information.diagonal() += priorInformation().tail<6>();
    const Eigen::Matrix<double, 6, 1> move =
        -information.ldlt().solve(rows.transpose() * weightedResiduals());
    state_.alignment = moved(state_.alignment, move, center_);
    state_.residuals = residuals_.at(state_.prediction, state_.alignment);
    if (move.head<3>().norm() < 1e-7 * size_m_ && move.tail<3>().norm() < 1e-7) return;
  }
}

FitState MaterialFit::evaluate(const Eigen::VectorXd& values, const Eigen::Isometry3d& alignment) {
  FitState state{values, alignment, model_.predict(materialWith(problem_->prior, unknowns_, values)), {}};
  state.residuals = residuals_.at(state.prediction, alignment);
  return state;
}

void MaterialFit::setWeights() {
  std::vector<double> absolute[Residuals::kGroups], usual(Residuals::kGroups, 1.0);
  const std::vector<ResidualPlace>& places = residuals_.places();
  for (std::size_t k = 0; k < places.size(); ++k)
    absolute[places[k].group].push_back(std::abs(state_.residuals[static_cast<Eigen::Index>(k)]));
  for (std::size_t g = 0; g < usual.size(); ++g) {
    if (absolute[g].empty()) continue;
    const bool is_wrench = g + 1 == usual.size();  // its stated deviation is at least its noise
    usual[g] = std::max(is_wrench ? 1.0 : kLeastNoise, medianOf(std::move(absolute[g])) / kMedianPerSigma);
  }
  weights_.resize(residuals_.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double unit = usual[static_cast<std::size_t>(places[k].group)],
                 size = std::abs(state_.residuals[row]) / unit;
    weights_[row] = std::sqrt(size > kHuber ? kHuber / size : 1.0) / unit;
  }
}

/// The mass has a known deviation. The alignment may shift by the body's size and turn by a radian.
Eigen::VectorXd MaterialFit::priorInformation() const {
  const auto count = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::VectorXd information = Eigen::VectorXd::Zero(count + 6);
  for (std::size_t k = 0; k < unknowns_.size(); ++k)
    if (unknowns_[k].property == Property::kDensity && std::isfinite(problem_->mass_std))
      information[static_cast<Eigen::Index>(k)] = 1.0 / (problem_->mass_std * problem_->mass_std);
  information.segment<3>(count).setConstant(1.0 / (size_m_ * size_m_));
  information.tail<3>().setOnes();
  return information;
}

void MaterialFit::linearize() {
  const auto count = static_cast<Eigen::Index>(unknowns_.size());
  jacobian_.setZero(residuals_.size(), count + 6);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::VectorXd values = state_.values;
    values[k] += kDifference;
    if (withinRange(unknowns_, values) != values) values[k] -= 2.0 * kDifference;
    const Prediction other = model_.predict(materialWith(problem_->prior, unknowns_, values));
    jacobian_.col(k) =
        residuals_.change(state_.prediction, other, state_.alignment) / (values[k] - state_.values[k]);
  }
  if (problem_->align)
    jacobian_.rightCols<6>() = residuals_.byAlignment(state_.prediction, state_.alignment, center_);
  jacobian_ = weights_.asDiagonal() * jacobian_;
  const Eigen::MatrixXd information =
      jacobian_.transpose() * jacobian_ + Eigen::MatrixXd(priorInformation().asDiagonal());
  // What nothing shows gets a deviation so large that its meaning is clear, but not infinite.
  covariance_ = (information + 1e-12 * Eigen::MatrixXd::Identity(count + 6, count + 6)).inverse();
}

double MaterialFit::objective(const FitState& state) const {
  double prior = 0.0;
  for (std::size_t k = 0; k < unknowns_.size(); ++k)
    prior += priorInformation()[static_cast<Eigen::Index>(k)] * state.values[static_cast<Eigen::Index>(k)] *
             state.values[static_cast<Eigen::Index>(k)];
  return misfit(state.residuals) + prior;
}

double MaterialFit::misfit(const Eigen::VectorXd& residuals) const {
  return weights_.cwiseProduct(residuals).squaredNorm();
}

/// One step that lowers the objective. @param fall by how much.
bool MaterialFit::improve(double* damping, double* fall) {
  const auto count = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::VectorXd gradient = jacobian_.transpose() * weightedResiduals();
  gradient.head(count) += priorInformation().head(count).cwiseProduct(state_.values);
  const Eigen::MatrixXd information = covariance_.inverse();
  for (int attempt = 0; attempt < 12; ++attempt, *damping *= 8.0) {
    Eigen::MatrixXd damped = information;
    damped.diagonal() *= 1.0 + *damping;
    for (Eigen::Index k = 0; k < count; ++k)  // what hardly shows moves little
      damped(k, k) += std::pow(longestStep(unknowns_[static_cast<std::size_t>(k)]), -2.0);
    Eigen::VectorXd step = -damped.ldlt().solve(gradient);
    double shorter = 1.0;
    for (Eigen::Index k = 0; k < count; ++k)
      shorter = std::min(shorter, longestStep(unknowns_[static_cast<std::size_t>(k)]) / std::abs(step[k]));
    step *= shorter;
    const Eigen::VectorXd values = withinRange(unknowns_, state_.values + step.head(count));
    try {
      FitState next = evaluate(
          values, problem_->align ? moved(state_.alignment, step.tail<6>(), center_) : state_.alignment);
      const double lower = objective(state_) - objective(next);
      if (lower < 0.0) continue;
      *fall = lower;
      state_ = std::move(next);
      *damping *= 0.1;
      return true;
    } catch (const std::runtime_error&) {
      continue;  // too soft to carry itself: a shorter step
    }
  }
  return false;
}

void MaterialFit::run(const std::function<void(double)>& progress) {
  constexpr int kIterations = 40;  // a bound: kNegligible ends it
  double damping = 1e-3;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    progress(static_cast<double>(iteration) / kIterations);
    model_.startAt(state_.prediction);
    setWeights();
    linearize();
    double fall = 0.0;
    if (!improve(&damping, &fall) || fall < kNegligible) break;
  }
  model_.startAt(state_.prediction);
  setWeights();
  linearize();
  progress(1.0);
}

Eigen::VectorXd MaterialFit::valuesThatExplain(const Prediction& other) const {
  const Eigen::VectorXd change =
      weights_.cwiseProduct(residuals_.change(state_.prediction, other, state_.alignment));
  return (covariance_ * (jacobian_.transpose() * change)).head(static_cast<Eigen::Index>(unknowns_.size()));
}

}  // namespace softbody
