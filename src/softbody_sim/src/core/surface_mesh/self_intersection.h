#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Whether two triangles of a mesh meet anywhere but in their common vertices and edges, exactly (CGAL).
bool intersectsItself(const TriangleMesh& mesh);

}  // namespace softbody
