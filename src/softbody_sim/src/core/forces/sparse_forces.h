#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace softbody {

/// What measurements say of forces f, three a place: chi^2(f) = chi^2(0) - 2 f . h + f . G f.
struct ForceEvidence {
  Eigen::MatrixXd G;
  Eigen::VectorXd h;
  double chi_square = 0.0;  ///< of no forces
  double count = 0.0;       ///< of scalar measurements
};

struct SparseForces {
  /// The mean on all places that each force may have, three a place.
  Eigen::VectorXd onPlaces(std::size_t place_count) const;

  std::vector<int> places;             ///< the most probable place of each force
  Eigen::VectorXd mean;                ///< three a force [N]
  Eigen::MatrixXd covariance;          ///< [N^2]
  std::vector<Eigen::VectorXd> where;  ///< of each force: probability of each place
};

/// The fewest forces that explain the measurements: each place has a normal prior of its own variance, and
/// the variances maximise the evidence (automatic relevance determination: MacKay 1992, Tipping 2001). A
/// force stays if zero is outside of its 99.9 % bound. That it may be on another place widens its covariance.
/// Where the measurements differ from the body by more than their variances say, all variances grow likewise.
/// @param scale_n size of a large force [N], from which the search starts.
SparseForces sparseForces(const ForceEvidence& evidence, double scale_n);

/// Forces that explain the measurements and are not yet sparse, for a first shape. @return three a place [N].
Eigen::VectorXd smoothForces(const ForceEvidence& evidence, double scale_n);

}  // namespace softbody
