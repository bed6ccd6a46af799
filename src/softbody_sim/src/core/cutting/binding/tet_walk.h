#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Point location by a visibility walk from tet to tet (Devillers et al. 2002). It never crosses a cut,
/// because the faces of a cut have only one tet.
class TetWalk {
 public:
  /// Keeps references to both.
  TetWalk(const Points& vertices, const Tets& tets);

  /// Walks from a tet towards a point, through faces that have the point on their other side. @return the
  /// place in the tet that contains the point; if the walk is blocked, in the visited tet with the least
  /// extrapolation.
  MaterialPoint towards(int tet, const Eigen::Vector3d& point) const;

 private:
  int nextTet(const MaterialPoint& place, const std::vector<int>& visited) const;

  const Points& vertices_;
  const Tets& tets_;
  std::vector<std::array<int, 4>>
      neighbours_;  ///< per tet and corner, the neighbour at the opposite face; or -1
};

}  // namespace softbody
