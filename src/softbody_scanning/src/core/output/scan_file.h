#pragma once

#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// A PLY (binary) with the vertex property `seen`, 0..1, beside x y z [m].
std::string scanPly(const TriangleMesh& mesh, const std::vector<float>& seen);

}  // namespace softbody::scanning
