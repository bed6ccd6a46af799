#pragma once

#include <limits>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Two parallel planes around a patch. With one test per vertex they show that most of a body is away from
/// the patch.
class PatchSlab {
 public:
  explicit PatchSlab(const TriangleMesh& patch);

  /// Per point -1 below the slab, 1 above, 0 between the planes.
  std::vector<signed char> sidesOf(const Points& points) const;

 private:
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

}  // namespace softbody
