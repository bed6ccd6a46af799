#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Which triangles to turn so that neighbours agree and every piece encloses a positive volume. Within a
/// piece the majority keeps its orientation. Across edges with more than two triangles nothing is concluded.
std::vector<bool> trianglesToTurn(const TriangleMesh& mesh);

}  // namespace softbody
