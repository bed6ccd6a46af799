#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Small motions of a body around its present shape: six rigid ones of each piece, whose vertices move by 1
/// in the root mean square, then the modes, turned with the body around each vertex (modal warping, Choi and
/// Ko 2005).
class TurnedModes {
 public:
  using Motions = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit TurnedModes(const TetTopology& topology);

  /// Columns before the modes.
  Eigen::Index rigidCount() const { return 6 * static_cast<Eigen::Index>(pieces_.size()); }

  /// @param shapes see DeformationModes. @param vertices present shape [m].
  /// @param motions 3 #V by (rigidCount() + modes).
  void at(const Points& vertices, const Eigen::MatrixXd& shapes, Motions* motions) const;

 private:
  std::vector<Eigen::Matrix3d> rotationsOf(const Points& vertices) const;

  const Tets tets_;
  const std::vector<std::vector<int>> pieces_;  ///< vertices of each piece
  std::vector<Eigen::Matrix3d> weighted_;       ///< per tet: volume * inverse of the rest edges
};

}  // namespace softbody
