#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The strain of a surface. What depends on the rest shape only is computed once.
class SurfaceStrain {
 public:
  explicit SurfaceStrain(const MeshTopology& topology);

  /// Per vertex: the largest relative change of length in any direction of the surface, |stretch - 1|, as the
  /// area-weighted mean of the adjacent triangles. 0 for a vertex without triangles.
  std::vector<float> at(const Points& vertices) const;

 private:
  Triangles triangles_;
  std::vector<Eigen::Matrix2d> inverse_rest_;  // per triangle: of its edges in its plane
  std::vector<double> areas_;
  std::vector<double> area_sums_;  // per vertex
};

/// Per vertex: distance from where it would be if its piece were rigid [m]. Each piece's rest shape is
/// fitted to its vertices (Kabsch).
std::vector<float> distancesFromRest(const MeshTopology& topology, const Points& vertices);

}  // namespace softbody
