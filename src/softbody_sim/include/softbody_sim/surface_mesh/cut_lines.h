#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// #E by 2 indices of vertices.
using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Where cuts run over a mesh: the edges at which a face of a cut meets the skin.
Edges cutLines(const MeshTopology& mesh);

}  // namespace softbody
