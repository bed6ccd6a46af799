#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::scanning {

/// The connected parts of a mesh.
std::vector<TriangleMesh> partsOf(const TriangleMesh& mesh);

}  // namespace softbody::scanning
