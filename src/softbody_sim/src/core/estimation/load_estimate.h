#pragma once

#include <Eigen/Core>
#include <vector>

#include "linear_solvers/dense_kernels.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// What is known of the external loads on an observed body.
struct LoadEstimate {
  Points per_mass;  ///< #V by 3 [m/s^2]
  /// Along the modes of each piece; empty: that of loads of which nothing is known.
  std::vector<Eigen::MatrixXd> covariances = {};
  bool edited = false;  ///< the body was cut after the last estimate
};

/// Where a body may be, after the targets of a step: each piece at x + motions a. The amplitudes a have the
/// covariance root root^T. Motions are in axes of each vertex.
struct ShapePosterior {
  /// Standard deviation of a piece's place if nothing measures it [m]: it may be anywhere near.
  static constexpr double kUnknown_m = 0.1;

  struct Piece {
    const std::vector<int>*
        vertices;  ///< of the estimator; valid until its next update, and so are the motions
    const DenseRows<float>* motions;  ///< x y z of each vertex by #amplitudes
    DenseRows<float> root;            ///< #amplitudes by paddedColumns(); motions of unit amplitude are in m
  };
  std::vector<Piece> pieces;
};

}  // namespace softbody
