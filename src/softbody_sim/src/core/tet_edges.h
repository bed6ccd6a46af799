#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Columns: from a tet's first vertex to its others [m].
inline Eigen::Matrix3d edgesOf(const Points& vertices, const Eigen::RowVector4i& tet) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = vertices.row(tet[k + 1]) - vertices.row(tet[0]);
  return edges;
}

}  // namespace softbody
