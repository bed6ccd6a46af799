#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Shape of every tet, from 1 (regular) to 0 (flat or inverted): mean ratio 12 (3 V)^(2/3) / sum of the
/// squared edge lengths (Liu and Joe 1994).
std::vector<float> tetQualities(const Points& vertices, const Tets& tets);

/// The strain of tets. What depends on the rest shape only is computed once.
class TetStrain {
 public:
  explicit TetStrain(const TetTopology& topology);

  /// Per tet: the largest relative change of length in any direction, |stretch - 1|. 0 for a tet that is flat
  /// at rest.
  std::vector<float> at(const Points& vertices) const;

 private:
  Tets tets_;
  std::vector<Eigen::Matrix3d> inverse_rest_;  // per tet; zero if it is flat
};

}  // namespace softbody
