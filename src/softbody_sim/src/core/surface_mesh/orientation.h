#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Which triangles to flip so that neighbours agree and every piece encloses a positive volume. The majority
/// of a piece keeps its orientation. Edges with more than two triangles are ignored.
std::vector<bool> trianglesToFlip(const TriangleMesh& mesh);

}  // namespace softbody
