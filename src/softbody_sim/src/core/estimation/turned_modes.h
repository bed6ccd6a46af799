#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Small motions of a body's pieces around its present shape: six rigid ones, whose vertices move by 1 in the
/// root mean square, then the modes, turned with the body around each vertex (modal warping, Choi and Ko
/// 2005). In the axes that turn with each vertex, the modes are always the same.
class TurnedModes {
 public:
  static constexpr Eigen::Index kRigid = 6;
  using Rigid = Eigen::Matrix<double, Eigen::Dynamic, kRigid, Eigen::RowMajor>;

  explicit TurnedModes(const TetTopology& topology);

  /// From the axes of each vertex to those of space, #V. @param vertices present shape [m].
  std::vector<Eigen::Matrix3d> rotationsOf(const Points& vertices) const;

  /// The rigid motions of a piece: x y z of each of its vertices, in its axes.
  Rigid rigidMotions(const std::vector<int>& piece, const Points& vertices,
                     const std::vector<Eigen::Matrix3d>& rotations) const;

 private:
  const Tets tets_;
  std::vector<Eigen::Matrix3d> weighted_;  ///< per tet: volume * inverse of the rest edges
};

}  // namespace softbody
