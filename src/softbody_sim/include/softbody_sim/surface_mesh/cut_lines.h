#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// #E by 2 indices of vertices.
using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The edges at which the faces of cuts meet the outer surface of a mesh.
Edges cutLines(const MeshTopology& mesh);

}  // namespace softbody
