#pragma once

#include <functional>
#include <vector>

#include "identification/forward_model.h"
#include "identification/residuals.h"
#include "identification/unknowns.h"

namespace softbody {

/// A point of the search.
struct FitState {
  Eigen::VectorXd values;  ///< of the unknowns
  Eigen::Isometry3d alignment = Eigen::Isometry3d::Identity();
  Prediction prediction;
  Eigen::VectorXd residuals;  ///< over the stated standard deviations
};

/// The search for the unknowns of a problem (Levenberg-Marquardt). Residuals count less, the larger they are
/// (Huber 1964), in units of what is usual for their kind.
class MaterialFit {
 public:
  /// @param problem must outlive this. @throw std::runtime_error if the prior has no equilibrium.
  MaterialFit(const MaterialProblem& problem, std::vector<Unknown> unknowns);

  /// @param progress is called with the finished fraction, 0..1.
  void run(const std::function<void(double)>& progress);

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  const FitState& state() const { return state_; }
  const Residuals& residuals() const { return residuals_; }
  Material material() const { return materialWith(problem_->prior, unknowns_, state_.values); }

  // At the end of run():
  /// #R by #U + 6, the alignment last; weighted, as weightedResiduals().
  const Eigen::MatrixXd& jacobian() const { return jacobian_; }
  Eigen::VectorXd weightedResiduals() const { return weights_.cwiseProduct(state_.residuals); }
  /// Of the unknowns and the alignment, from independent errors.
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  /// By how much the unknowns of this mesh differ if the body does what another prediction for them says.
  Eigen::VectorXd valuesThatExplain(const Prediction& other) const;
  /// The sum of the robust squares of residuals of a state.
  double misfit(const Eigen::VectorXd& residuals) const;

 private:
  FitState evaluate(const Eigen::VectorXd& values, const Eigen::Isometry3d& alignment);
  void align();
  void setWeights();
  void linearize();
  bool improve(double* damping, double* fall);
  double objective(const FitState& state) const;
  Eigen::VectorXd priorInformation() const;

  const MaterialProblem* problem_;
  std::vector<Unknown> unknowns_;
  ForwardModel model_;
  Residuals residuals_;
  Eigen::Vector3d center_;  ///< of the targets [m]
  double size_m_;           ///< of the body
  FitState state_;
  Eigen::VectorXd weights_;  ///< #R, square roots
  Eigen::MatrixXd jacobian_, covariance_;
};

}  // namespace softbody
