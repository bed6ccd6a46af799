#pragma once

#include <array>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Walks through tets from face to face: it never crosses a cut, whose faces belong to one tet each.
class TetWalk {
 public:
  /// Keeps references to both.
  TetWalk(const Points& vertices, const Tets& tets);

  /// From a tet towards a point, through faces that have the point beyond them. @return the point's place in
  /// the tet that contains it; where the way is barred, in the one passed that needs least extrapolation.
  MaterialPoint towards(int tet, const Eigen::Vector3d& point) const;

 private:
  int nextTet(const MaterialPoint& place, const std::vector<int>& passed) const;

  const Points& vertices_;
  const Tets& tets_;
  std::vector<std::array<int, 4>> neighbours_;  ///< per tet and corner, beyond the face opposite to it; or -1
};

}  // namespace softbody
