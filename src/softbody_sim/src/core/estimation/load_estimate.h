#pragma once

#include <Eigen/Core>

#include "softbody_common/types.h"

namespace softbody {

/// What is known of the external loads on an observed body.
struct LoadEstimate {
  Points per_mass;                  ///< #V by 3 [m/s^2]
  Eigen::MatrixXd covariance = {};  ///< along the modes; empty: that of loads of which nothing is known
  bool edited = false;              ///< the body was cut after the last estimate
};

/// Where a body may be, after the targets of a step: x + motions a, with amplitudes a of a covariance.
struct ShapePosterior {
  /// Standard deviation of a piece's place if nothing measures it [m]: it may be anywhere near.
  static constexpr double kUnknown_m = 0.1;

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> motions;  ///< 3 #V by #amplitudes
  Eigen::MatrixXd covariance;  ///< motions of unit amplitude are in m
};

}  // namespace softbody
