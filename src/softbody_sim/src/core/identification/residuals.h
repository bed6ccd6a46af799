#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "identification/forward_model.h"
#include "softbody_sim/identification/material_problem.h"

namespace softbody {

/// Where a residual was measured. Residuals near each other, or of one image, may have the same error.
struct ResidualPlace {
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();  ///< of a target [m]
  int sensor = -1;                                 ///< of a wrench; -1: it is a target's
  int image = 0;
  int group = 0;  ///< residuals of one group have the same unit of noise: the kind of target, or wrenches
};

/// The residuals of a problem over their stated standard deviations, and their derivatives by the simulated
/// places and wrenches.
class Residuals {
 public:
  static constexpr int kGroups = 6;  ///< kinds of targets, then wrenches

  explicit Residuals(const MaterialProblem& problem);

  Eigen::Index size() const { return static_cast<Eigen::Index>(places_.size()); }
  const std::vector<ResidualPlace>& places() const { return places_; }

  Eigen::VectorXd at(const Prediction& prediction, const Eigen::Isometry3d& alignment) const;
  /// The same linear map without the measurements: of a change of places and wrenches.
  Eigen::VectorXd change(const Prediction& from, const Prediction& to,
                         const Eigen::Isometry3d& alignment) const;
  /// By a shift and a turn about `center` that follow the alignment, #R by 6.
  Eigen::MatrixXd byAlignment(const Prediction& prediction, const Eigen::Isometry3d& alignment,
                              const Eigen::Vector3d& center) const;

 private:
  Eigen::VectorXd whitened(const Points& places, const Eigen::VectorXd& wrenches) const;

  std::vector<const Target*> targets_;
  std::vector<const MeasuredWrench*> wrenches_;
  std::vector<ResidualPlace> places_;
};

}  // namespace softbody
